// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/dicom_identifiers.h"
#include "cases/dicom_number.h"

namespace theatron::cases {
namespace {

constexpr DicomTag rows_tag = 0x00280010, columns_tag = 0x00280011, frames_tag = 0x00280008,
                   slope_tag = 0x00281053, intercept_tag = 0x00281052, center_tag = 0x00281050,
                   width_tag = 0x00281051, position_tag = 0x00200032, orientation_tag = 0x00200037,
                   spacing_tag = 0x00280030, table_tag = 0x00283000;

StoredBits bits_of(const DicomSet& set, std::string& problem) {
    StoredBits bits;
    bits.allocated = set.integer(0x00280100, 16);
    bits.stored = set.integer(0x00280101, bits.allocated);
    bits.high = set.integer(0x00280102, bits.stored - 1);
    const int kind = set.integer(0x00280103, 0);
    bits.is_signed = kind == 1;
    if (kind != 0 && kind != 1)
        problem = "has the pixel representation " + std::to_string(kind) +
                  ", where only 0 and 1 have a meaning; export it again";
    if (bits.stored < 1 || bits.stored > bits.allocated || bits.high < bits.stored - 1 ||
        bits.high >= bits.allocated)
        problem = "says that its values have " + std::to_string(bits.stored) +
                  " bits, the highest of which is bit " + std::to_string(bits.high) + " of " +
                  std::to_string(bits.allocated) + ", which cannot be; export it again";
    return bits;
}

ValueTable table_of(const DicomSet& set, const StoredBits& bits, std::string& problem) {
    ValueTable table;
    const std::vector<DicomSet> items = set.items(table_tag);
    // The table of an X-ray makes no measured values (PS3.3, C.8.7.1.1.2).
    const std::string modality = set.text(0x00080060);
    if (items.empty() || modality == "XA" || modality == "RF")
        return table;
    const std::vector<int> about = items[0].words(0x00283002, false);
    table.values = items[0].words(0x00283006, false);
    if (about.size() >= 3) {
        table.first = bits.is_signed ? std::int16_t(about[1]) : about[1];
        const std::size_t count = about[0] == 0 ? 65'536 : std::size_t(about[0]);
        if (about[2] == 8 && table.values.size() * 2 >= count && table.values.size() < count) {
            // Two values in each word.
            std::vector<int> bytes;
            for (const int word : table.values)
                bytes.insert(bytes.end(), {word & 255, word >> 8});
            table.values = std::move(bytes);
        }
        if (table.values.size() >= count) {
            table.values.resize(count);
            return table;
        }
    }
    problem = "has a damaged table of its values (Modality LUT Sequence); export it again";
    table.values.clear();
    return table;
}

// The item of a sequence ("macro") of this frame, or of all frames; without one, the file itself.
const DicomSet& set_with(const DicomFile& file, const DicomImage& image, int frame, DicomTag macro,
                         DicomSet& kept) {
    if (image.of_all.empty() && image.of_each.empty())
        return file.set;
    const std::vector<DicomSet>* const all[] = {&image.of_each, &image.of_all};
    for (const std::vector<DicomSet>* const sets : all) {
        const std::size_t at = sets == &image.of_each ? std::size_t(frame) : 0;
        if (at >= sets->size())
            continue;
        std::vector<DicomSet> items = (*sets)[at].items(macro);
        if (!items.empty()) {
            kept = std::move(items[0]);
            return kept;
        }
    }
    return file.set;
}

void read_place(const DicomFile& file, const DicomImage& image, int frame, DicomSlice& slice) {
    struct Wanted {
        DicomTag macro, tag;
        const char* name;
        int count;
    };
    constexpr Wanted wanted[] = {{0x00209116, orientation_tag, "orientation", 6},
                                 {0x00209113, position_tag, "position", 3},
                                 {0x00289110, spacing_tag, "pixel spacing", 2}};
    double values[3][6];
    Field found[3];
    std::string problem;
    for (int i = 0; i < 3; ++i) {
        DicomSet kept;
        const DicomSet& set = set_with(file, image, frame, wanted[i].macro, kept);
        found[i] = dicom_decimals(set, wanted[i].tag, values[i], wanted[i].count);
        if (found[i] == Field::bad && problem.empty())
            problem = bad_field(set, wanted[i].tag, wanted[i].name, wanted[i].count);
    }
    // An image without a place has no use for the spacing.
    if (found[0] == Field::absent || found[1] == Field::absent || found[2] == Field::absent)
        return;
    if (!problem.empty()) {
        slice.problem = problem;
        return;
    }
    slice.right = {values[0][0], values[0][1], values[0][2]};
    slice.down = {values[0][3], values[0][4], values[0][5]};
    slice.position_mm = {values[1][0], values[1][1], values[1][2]};
    slice.row_spacing_mm = values[2][0];
    slice.column_spacing_mm = values[2][1];
    if (!(length(slice.right) > 0.5) || !(length(slice.down) > 0.5))
        return;
    slice.right = normalized(slice.right);
    slice.down = normalized(slice.down);
    slice.has_place = true;
}

void read_scale(const DicomSet& set, const DicomImage& image, DicomSlice& slice) {
    const Field slope = dicom_decimals(set, slope_tag, &slice.slope, 1);
    const Field intercept = dicom_decimals(set, intercept_tag, &slice.intercept, 1);
    if (slope == Field::absent)
        slice.slope = 1;
    if (intercept == Field::absent)
        slice.intercept = 0;
    if (slope == Field::bad)
        slice.problem = bad_field(set, slope_tag, "rescale slope", 1);
    else if (intercept == Field::bad)
        slice.problem = bad_field(set, intercept_tag, "rescale intercept", 1);
    else if (slice.slope == 0)
        slice.problem = "has a rescale slope of 0, so its values have no meaning; export it again";
    if (!image.table.values.empty()) {
        const bool has_scale = slice.slope != 1 || slice.intercept != 0;
        if (has_scale && slice.problem.empty())
            slice.problem =
                "has both a rescale slope and a table of values (Modality LUT Sequence), so its "
                "values have two meanings; export it again";
        slice.slope = 1;
        slice.intercept = 0;
    }
}

void read_window(const DicomSet& set, DicomSlice& slice) {
    medical::Window window{0, 0};
    const Field center = dicom_decimals(set, center_tag, &window.center, 1);
    const Field width = dicom_decimals(set, width_tag, &window.width, 1);
    if (center == Field::absent || width == Field::absent)
        return;
    constexpr double limit = 1e9;
    slice.has_window = center == Field::good && width == Field::good && window.width > 0 &&
                       window.width <= limit && std::abs(window.center) <= limit;
    // The values are right without it, so it is no refusal.
    slice.has_wrong_window = !slice.has_window;
    if (slice.has_window)
        slice.window = window;
}

// See series_parts.h.
constexpr DicomTag key_tags[slice_keys] = {0x00200100,   // temporal position
                                           0x00200012,   // acquisition
                                           0x00180086,   // echo
                                           0x00189087,   // diffusion's b-value
                                           0x00080008,   // kind of image
                                           0x00181210,   // kernel
                                           0x00181060,   // time after the trigger
                                           0x00180082,   // time after an inversion
                                           0x00080032,   // time of acquisition
                                           0x00080033};  // time of the content

void read_padding(const DicomSet& set, bool is_signed, DicomSlice& slice) {
    const std::vector<int> one = set.words(0x00280120, is_signed);
    const std::vector<int> other = set.words(0x00280121, is_signed);
    if (one.empty())
        return;
    const auto [low, high] = std::minmax(one[0], other.empty() ? one[0] : other[0]);
    slice.has_padding = true;
    slice.padding_low = low;
    slice.padding_high = high;
}

// Objects whose values mean nothing without other fields (PS3.4, B.5), as of a dose its scaling and
// of a segmentation its segments; content for all others.
Answer kind_of_object(const DicomSet& set) {
    const std::string object = set.text(0x00080016), modality = set.text(0x00080060);
    const auto is = [&](std::string_view end) {
        return object == "1.2.840.10008.5.1.4.1.1." + std::string(end);
    };
    if (is("481.2") || modality == "RTDOSE")
        return Answer::dose;
    if (is("66.4") || is("66.5") || is("66.7") || is("481.3") || modality == "SEG" ||
        modality == "RTSTRUCT")
        return Answer::segmentation;
    if (is("30"))
        return Answer::map;
    if (is("104.3") || is("104.4"))
        return Answer::document;
    return is("66") ? Answer::no_image : Answer::content;  // 66: raw data
}

Answer kind_of(const DicomSet& set, const DicomImage& image) {
    constexpr DicomTag float_pixels = 0x7fe00008, double_pixels = 0x7fe00009;
    if (const Answer other = kind_of_object(set); other != Answer::content)
        return other;
    if (set.has(float_pixels) || set.has(double_pixels))
        return Answer::other_samples;
    if (set.is_cut_off() && !set.has(pixel_data_tag))
        return Answer::cut_off;
    // These have pixels, unless the file ends before them.
    const std::string kind_of_object = set.text(0x00080016);
    for (const char* slices : {"2", "2.1", "2.2", "4", "4.1", "4.4", "128", "128.1", "130"})
        if (kind_of_object == std::string("1.2.840.10008.5.1.4.1.1.") + slices &&
            !set.has(pixel_data_tag))
            return Answer::cut_off;
    if (image.columns < 1 || image.rows < 1)
        return Answer::no_image;
    if (!set.has(pixel_data_tag))
        return Answer::cut_off;
    const std::string kind = set.text(0x00280004);
    if (set.integer(0x00280002, 1) != 1 || kind.starts_with("PALETTE") || kind.starts_with("RGB") ||
        kind.starts_with("YBR"))
        return Answer::color;
    if (image.bits.allocated != 8 && image.bits.allocated != 16)
        return Answer::other_samples;
    if (image.columns > medical::max_volume_side || image.rows > medical::max_volume_side)
        return Answer::too_large;
    const bool has_places = !image.of_each.empty() || !image.of_all.empty();
    // Siemens lays the slices of a volume side by side in one picture.
    const bool is_mosaic = set.text(0x00080008).find("MOSAIC") != std::string::npos;
    if (image.frames < 1 || image.frames > max_frames || (image.frames > 1 && !has_places) ||
        (is_mosaic && !has_places))
        return Answer::many_frames;
    return Answer::content;
}

std::string problem_of_repeated(const DicomSet& set) {
    constexpr std::pair<DicomTag, const char*> wanted[] = {
        {rows_tag, "number of rows"},        {columns_tag, "number of columns"},
        {slope_tag, "rescale slope"},        {intercept_tag, "rescale intercept"},
        {position_tag, "position"},          {orientation_tag, "orientation"},
        {spacing_tag, "pixel spacing"},      {0x00280101, "number of bits stored"},
        {0x00280103, "pixel representation"}};
    for (const auto& [tag, name] : wanted)
        if (set.has_two_values(tag))
            return std::string("has two values of its ") + name + "; export it again";
    return "";
}

// Pixels of more bits or more images than are said would be shown as other values.
std::string problem_of_pixels(const DicomSet& set, const DicomImage& image) {
    const DicomElement* const pixels = set.find(pixel_data_tag);
    if (!pixels || pixels->is_open || image.columns < 1 || image.rows < 1 || image.frames < 1)
        return "";
    const std::size_t announced = std::size_t(image.columns) * std::size_t(image.rows) *
                                  std::size_t(image.frames) *
                                  std::size_t(std::max(image.bits.allocated / 8, 1));
    if (pixels->value.size() / 2 < announced)
        return "";
    return "holds at least twice the pixels that its size, its bits and its number of images "
           "announce, so it is not known what they mean; export it again";
}

}  // namespace

int ValueTable::value_of(int stored) const {
    const auto last = std::ptrdiff_t(values.size()) - 1;
    return values[std::size_t(std::clamp<std::ptrdiff_t>(stored - first, 0, last))];
}

DicomImage describe_image(const DicomFile& file) {
    const DicomSet& set = file.set;
    DicomImage image;
    DicomSlice& common = image.common;
    image.columns = set.integer(columns_tag, 0);
    image.rows = set.integer(rows_tag, 0);
    image.frames = set.integer(frames_tag, 1);
    if (image.frames == 0)
        image.frames = 1;  // some programs say 0 of a single image
    image.of_all = set.items(DicomTag(0x52009229));
    image.of_each = set.items(DicomTag(0x52009230));
    if (!image.of_each.empty() && image.of_each.size() != std::size_t(std::max(image.frames, 0)))
        common.problem = "says that it has " + std::to_string(image.frames) +
                         " images and describes " + std::to_string(image.of_each.size()) +
                         "; export it again";
    image.bits = bits_of(set, common.problem);
    image.table = table_of(set, image.bits, common.problem);
    common.series_uid = set.text(0x0020000e, max_dicom_text);
    common.frame_uid = set.text(0x00200052, max_dicom_text);
    common.modality = set.text(0x00080060, 16);
    common.deidentified = set.text(0x00120062) == "YES";
    common.instance = set.integer(0x00200013, 0);
    common.inverted = set.text(0x00280004) == "MONOCHROME1";
    common.charset = set.text(0x00080005, max_dicom_text);
    common.identifiers = identifiers_in(set);
    for (std::size_t i = 0; i < slice_keys; ++i)
        common.keys[i] = set.text(key_tags[i], 64);
    image.what = kind_of(set, image);
    if (image.what == Answer::content && common.problem.empty())
        common.problem = problem_of_pixels(set, image);
    if (image.what == Answer::content && common.problem.empty())
        common.problem = problem_of_repeated(set);
    return image;
}

DicomSlice describe_frame(const DicomFile& file, const DicomImage& image, int frame) {
    DicomSlice slice = image.common;
    if (!slice.problem.empty())
        return slice;
    slice.columns = image.columns;
    slice.rows = image.rows;
    slice.instance += frame;
    DicomSet kept;
    read_place(file, image, frame, slice);
    if (slice.problem.empty())
        read_scale(set_with(file, image, frame, 0x00289145, kept), image, slice);
    read_window(set_with(file, image, frame, 0x00289132, kept), slice);
    read_padding(file.set, image.bits.is_signed, slice);
    if (!image.of_each.empty()) {
        // The frame's content: temporal position, stack.
        const DicomSet& content = set_with(file, image, frame, 0x00209111, kept);
        slice.keys[0] = std::to_string(content.integer(0x00209128, 0));
        slice.keys[1] = content.text(0x00209056, 64);
        DicomSet kept_diffusion;
        const DicomSet& diffusion = set_with(file, image, frame, 0x00189117, kept_diffusion);
        double b_value = 0;
        if (dicom_decimals(diffusion, 0x00189087, &b_value, 1) == Field::good)
            slice.keys[3] = std::to_string(b_value);
    }
    return slice;
}

void take_samples(const DicomImage& image, const StoredBits& bits, std::vector<int>& raw,
                  DicomSlice& slice) {
    const int unused = bits.high + 1 - bits.stored;
    const unsigned mask = (1u << bits.stored) - 1, sign = 1u << (bits.stored - 1);
    for (int& value : raw) {
        // Only the stored bits belong to a value; overlays may use the others.
        unsigned stored = unsigned(value) >> unused & mask;
        if (bits.is_signed && stored & sign)
            stored |= ~mask;
        value = image.table.values.empty() ? int(stored) : image.table.value_of(int(stored));
    }
    if (!image.table.values.empty())
        slice.has_padding = false;
    slice.lowered = std::any_of(raw.begin(), raw.end(), [](int v) { return v > 32'767; });
    slice.samples.resize(raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i)
        slice.samples[i] = std::int16_t(raw[i] - (slice.lowered ? 32'768 : 0));
    if (slice.lowered) {
        slice.padding_low -= 32'768;
        slice.padding_high -= 32'768;
    }
}

}  // namespace theatron::cases
