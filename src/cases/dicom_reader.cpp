// SPDX-License-Identifier: Apache-2.0
// Reads DICOM images with GDCM. Runs in a sandbox, because the library is large and the files are
// untrusted.
#include <gdcmAttribute.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmStringFilter.h>
#include <gdcmTrace.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <streambuf>

#include "cases/dicom_identifiers.h"
#include "cases/dicom_slice.h"
#include "cases/foreign_answer.h"
#include "cases/foreign_files.h"

namespace theatron::cases {
namespace {

// The bytes behind a descriptor, as a stream.
class DescriptorBuffer : public std::streambuf {
public:
    explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
        size_ = lseek(descriptor, 0, SEEK_END);
    }

    // True if a read reached beyond the end of the file.
    bool is_cut_off() const { return cut_off_; }

protected:
    std::streamsize xsgetn(char* out, std::streamsize wanted) override {
        const std::streamsize got = std::streambuf::xsgetn(out, wanted);
        // At the end of a whole file the library tries to read one more tag.
        constexpr std::streamsize tag = 4;
        cut_off_ = cut_off_ || (got < wanted && (got > 0 || wanted > tag));
        return got;
    }
    int_type underflow() override {
        const off_t at = place();
        const ssize_t count = pread(descriptor_, buffer_, sizeof(buffer_), at);
        if (count <= 0)
            return traits_type::eof();
        start_ = at;
        setg(buffer_, buffer_, buffer_ + count);
        return traits_type::to_int_type(*gptr());
    }
    pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                     std::ios_base::openmode) override {
        const off_type base = from == std::ios_base::beg   ? 0
                              : from == std::ios_base::cur ? place()
                                                           : size_;
        return move(base + offset);
    }
    pos_type seekpos(pos_type to, std::ios_base::openmode) override { return move(off_type(to)); }

private:
    off_t place() const { return start_ + (gptr() - eback()); }
    pos_type move(off_type to) {
        if (to < 0 || to > size_)
            return pos_type(off_type(-1));
        start_ = to;
        setg(buffer_, buffer_, buffer_);
        return to;
    }

    int descriptor_;
    off_t size_ = 0;
    bool cut_off_ = false;
    off_t start_ = 0;  // of the buffer, in the file
    char buffer_[64 << 10];
};

using gdcm::Tag;

const Tag pixel_data(0x7fe0, 0x0010);

class Tags {
public:
    explicit Tags(const gdcm::DataSet& data) : data_(data) {}

    bool has(std::uint16_t group, std::uint16_t element) const {
        return data_.FindDataElement(Tag(group, element));
    }

    std::string text(std::uint16_t group, std::uint16_t element, std::size_t most = 0) const {
        const Tag tag(group, element);
        if (!data_.FindDataElement(tag))
            return "";
        const gdcm::ByteValue* value = data_.GetDataElement(tag).GetByteValue();
        if (!value)
            return "";
        std::string text(value->GetPointer(),
                         std::min<std::size_t>(value->GetLength(), most ? most : 256));
        while (!text.empty() && (text.back() == ' ' || text.back() == '\0'))
            text.pop_back();
        return text;
    }

    // Numbers written as text, parted by backslashes. False unless all are there.
    bool numbers(std::uint16_t group, std::uint16_t element, double* out, int count) const {
        const std::string list = text(group, element);
        const char* at = list.c_str();
        for (int i = 0; i < count; ++i) {
            char* end = nullptr;
            out[i] = std::strtod(at, &end);
            if (end == at || !std::isfinite(out[i]))
                return false;
            while (*end == ' ')
                ++end;
            if (i + 1 < count && *end != '\\')
                return false;
            at = end + 1;
        }
        return true;
    }
    double number(std::uint16_t group, std::uint16_t element, double fallback) const {
        double value;
        return numbers(group, element, &value, 1) ? value : fallback;
    }

private:
    const gdcm::DataSet& data_;
};

void read_place(const Tags& tags, DicomSlice& slice) {
    double orientation[6], position[3], spacing[2];
    if (!tags.numbers(0x0020, 0x0037, orientation, 6) ||
        !tags.numbers(0x0020, 0x0032, position, 3) || !tags.numbers(0x0028, 0x0030, spacing, 2))
        return;
    slice.right = {orientation[0], orientation[1], orientation[2]};
    slice.down = {orientation[3], orientation[4], orientation[5]};
    slice.position_mm = {position[0], position[1], position[2]};
    slice.row_spacing_mm = spacing[0];
    slice.column_spacing_mm = spacing[1];
    if (!(length(slice.right) > 0.5) || !(length(slice.down) > 0.5))
        return;
    slice.right = normalized(slice.right);
    slice.down = normalized(slice.down);
    slice.has_place = true;
}

void read_tags(const Tags& tags, DicomSlice& slice) {
    slice.series_uid = tags.text(0x0020, 0x000e, max_dicom_text);
    slice.frame_uid = tags.text(0x0020, 0x0052, max_dicom_text);
    slice.modality = tags.text(0x0008, 0x0060, 16);
    slice.deidentified = tags.text(0x0012, 0x0062) == "YES";
    slice.slope = tags.number(0x0028, 0x1053, 1);
    slice.intercept = tags.number(0x0028, 0x1052, 0);
    slice.window.center = tags.number(0x0028, 0x1050, 0);
    slice.window.width = tags.number(0x0028, 0x1051, 0);
    slice.has_window = slice.window.width >= 1;
    if (!slice.has_window)
        slice.window = {};
    read_place(tags, slice);
}

// Copies the stored values, which have type T, out of the library's buffer.
template <class T>
void copy_samples(const std::vector<char>& buffer, std::vector<int>& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        T value;
        std::memcpy(&value, buffer.data() + i * sizeof(T), sizeof(T));
        out[i] = value;
    }
}

// Only the stored bits belong to a value; overlays may use the others.
int stored_value(int raw, const gdcm::PixelFormat& format) {
    const int bits = format.GetBitsStored(), unused = int(format.GetHighBit()) + 1 - bits;
    unsigned value = unsigned(raw) >> std::max(unused, 0) & ((1u << bits) - 1);
    if (format.GetPixelRepresentation() && value >> (bits - 1))
        value |= ~0u << bits;
    return int(value);
}

Answer read_samples(gdcm::Image& image, DicomSlice& slice) {
    const gdcm::PixelFormat& format = image.GetPixelFormat();
    if (format.GetSamplesPerPixel() != 1)
        return Answer::color;
    if (image.GetNumberOfDimensions() > 2 && image.GetDimension(2) > 1)
        return Answer::many_frames;
    const unsigned columns = image.GetDimension(0), rows = image.GetDimension(1);
    if (columns < 1 || rows < 1 || columns > unsigned(medical::max_volume_side) ||
        rows > unsigned(medical::max_volume_side))
        return Answer::too_large;
    const std::size_t count = std::size_t(columns) * rows;
    const int allocated = format.GetBitsAllocated();
    const int bits = format.GetBitsStored();
    if ((allocated != 8 && allocated != 16) || bits < 1 || bits > allocated ||
        format.GetHighBit() >= allocated ||
        image.GetBufferLength() != count * std::size_t(allocated / 8))
        return Answer::compression;
    std::vector<char> buffer(image.GetBufferLength());
    if (!image.GetBuffer(buffer.data()))
        return Answer::compression;
    std::vector<int> values(count);
    if (allocated == 8)
        copy_samples<std::uint8_t>(buffer, values);
    else
        copy_samples<std::uint16_t>(buffer, values);
    for (int& value : values)
        value = stored_value(value, format);
    slice.columns = int(columns);
    slice.rows = int(rows);
    slice.lowered = std::any_of(values.begin(), values.end(), [](int v) { return v > 32767; });
    slice.samples.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        slice.samples[i] = std::int16_t(values[i] - (slice.lowered ? 32768 : 0));
    return Answer::content;
}

// False only where the file names a transfer syntax that the library does not know.
bool is_known_compression(const gdcm::FileMetaInformation& header) {
    const std::string syntax = Tags(header).text(0x0002, 0x0010);
    return syntax.empty() ||
           gdcm::TransferSyntax::GetTSType(syntax.c_str()) != gdcm::TransferSyntax::TS_END;
}

// Reads what stands before the pixels: the texts that identify the patient, also of files that are
// no slices. Returns true for colours that are numbers in a table: where the table is not there,
// the library ends the process, so that such an image must not be read further.
bool read_head(int descriptor, DicomSlice& slice) {
    DescriptorBuffer buffer(descriptor);
    std::istream stream(&buffer);
    gdcm::Reader reader;
    reader.SetStream(stream);
    if (!reader.ReadUpToTag(pixel_data))
        return false;
    const Tags tags(reader.GetFile().GetDataSet());
    slice.charset = tags.text(0x0008, 0x0005, max_dicom_text);
    slice.identifiers = identifiers_in(reader.GetFile().GetDataSet());
    return tags.text(0x0028, 0x0004).starts_with("PALETTE");
}

Answer read(int descriptor, DicomSlice& slice) {
    if (const bool has_palette = read_head(descriptor, slice); has_palette)
        return Answer::color;
    DescriptorBuffer buffer(descriptor);
    std::istream stream(&buffer);
    gdcm::ImageReader reader;
    reader.SetStream(stream);
    const bool good = reader.Read();
    // The library fills up missing bytes without an error.
    if (buffer.is_cut_off())
        return Answer::cut_off;
    const gdcm::DataSet& data = reader.GetFile().GetDataSet();
    const Tags tags(data);
    if (!good && !is_known_compression(reader.GetFile().GetHeader()))
        return Answer::compression;
    if (!good) {
        if (data.IsEmpty() || tags.has(0x7fe0, 0x0010))
            return Answer::unreadable;
        const bool has_image_size = tags.has(0x0028, 0x0010) && tags.has(0x0028, 0x0011);
        return has_image_size ? Answer::cut_off : Answer::no_image;
    }
    read_tags(tags, slice);
    if (slice.slope == 0)
        return Answer::no_scale;
    gdcm::Image& image = reader.GetImage();
    // The library fills up missing pixels without an error, as it does with missing bytes.
    const gdcm::ByteValue* pixels =
        tags.has(0x7fe0, 0x0010) ? data.GetDataElement(pixel_data).GetByteValue() : nullptr;
    const bool is_plain = !image.GetTransferSyntax().IsEncapsulated();
    if (is_plain && (!pixels || pixels->GetLength() < image.GetBufferLength()))
        return Answer::cut_off;
    slice.inverted =
        image.GetPhotometricInterpretation() == gdcm::PhotometricInterpretation::MONOCHROME1;
    return read_samples(image, slice);
}

}  // namespace

void serve_dicom(sandbox::Inside& inside) {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    while (inside.receive()) {
        DicomSlice slice;
        Answer result = Answer::unreadable;
        try {
            result = read(inside.input(), slice);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception&) {
        }
        if (result == Answer::content)
            answer(inside, encode(slice));
        else
            answer(inside, result, encode_identifiers(slice));
    }
}

}  // namespace theatron::cases
