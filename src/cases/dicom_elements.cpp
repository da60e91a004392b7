// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_elements.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "cases/inflate.h"

namespace theatron::cases {
namespace {

constexpr DicomTag item = 0xfffee000, end_of_item = 0xfffee00d, end_of_sequence = 0xfffee0dd;
constexpr std::uint32_t undefined_length = 0xffffffff;
constexpr std::size_t max_elements = 1'000'000;
constexpr int deepest_item = 16;

bool is_representation(const char* at) {
    constexpr std::string_view known =
        "AE AS AT CS DA DS DT FD FL IS LO LT OB OD OF OL OV OW PN SH SL SQ SS ST SV TM UC UI UL UN "
        "UR US UT UV";
    for (std::size_t i = 0; i < known.size(); i += 3)
        if (at[0] == known[i] && at[1] == known[i + 1])
            return true;
    return false;
}

// Those whose length has 32 bits, behind two empty bytes.
bool has_long_length(const std::array<char, 2>& r) {
    constexpr std::string_view names = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
    for (std::size_t i = 0; i < names.size(); i += 3)
        if (r[0] == names[i] && r[1] == names[i + 1])
            return true;
    return false;
}

std::uint32_t number_at(ByteView bytes, std::size_t at, std::size_t size, bool big_endian) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value |= std::to_integer<std::uint32_t>(bytes[at + i])
                 << (8 * (big_endian ? size - 1 - i : i));
    return value;
}

class Elements {
public:
    Elements(ByteView bytes, DicomEncoding encoding, int depth)
        : bytes_(bytes), encoding_(encoding), depth_(depth) {}

    std::size_t place() const { return at_; }
    // True if bytes are left that are too few for an element, and are not only zeros.
    bool ends_in_a_head() const {
        const ByteView rest = bytes_.subspan(at_);
        return rest.size() < 12 &&
               std::any_of(rest.begin(), rest.end(), [](std::byte b) { return b != std::byte(0); });
    }

    // False at the end, and at bytes that are no element.
    bool next(DicomElement& out) {
        if (bytes_.size() - at_ < 8)
            return false;
        out = {};
        out.tag = tag_at(at_);
        if (out.tag == 0)
            return false;
        if (out.tag >> 16 == 0xfffe) {
            at_ += 8;  // the end of an item or of a sequence
            return false;
        }
        const char* letters = reinterpret_cast<const char*>(bytes_.data()) + at_ + 4;
        Head head = Head::bare;
        if (encoding_.has_representations && is_representation(letters)) {
            out.representation = {letters[0], letters[1]};
            head = has_long_length(out.representation) ? Head::long_length : Head::short_length;
        } else if (encoding_.has_representations) {
            head = head_of_unknown();
        }
        const std::size_t size = size_of(head);
        if (bytes_.size() - at_ < size)
            return false;
        const std::uint32_t length = length_at(head);
        at_ += size;
        const std::size_t begin = at_;
        if (length == undefined_length) {
            out.is_open = true;
            if (!skip_items(out.representation == std::array{'U', 'N'}))
                out.is_cut_off = out.tag != pixel_data_tag;
        } else {
            out.is_cut_off = length > bytes_.size() - at_;
            at_ += std::min<std::size_t>(length, bytes_.size() - at_);
        }
        out.value = bytes_.subspan(begin, at_ - begin);
        return true;
    }

private:
    std::uint32_t number(std::size_t at, std::size_t size) const {
        return number_at(bytes_, at, size, encoding_.big_endian);
    }
    DicomTag tag_at(std::size_t at) const { return number(at, 2) << 16 | number(at + 2, 2); }

    // How the head of an element goes on behind its tag: with a length of 32 bits; with two letters
    // and a length of 16; with two letters, two empty bytes and a length of 32.
    enum class Head : std::uint8_t { bare, short_length, long_length };
    static std::size_t size_of(Head head) { return head == Head::long_length ? 12 : 8; }
    std::uint32_t length_at(Head head) const {
        return head == Head::bare           ? number(at_ + 4, 4)
               : head == Head::short_length ? number(at_ + 6, 2)
                                            : number(at_ + 8, 4);
    }
    // Some devices leave the representation out of single elements, others write one that the
    // standard has not: the head is the one behind whose value an element follows, or nothing.
    Head head_of_unknown() const {
        const std::size_t left = bytes_.size() - at_;
        for (const Head head : {Head::bare, Head::short_length, Head::long_length}) {
            const std::size_t size = size_of(head);
            if (left < size || length_at(head) > left - size)
                continue;
            const ByteView behind = bytes_.subspan(at_ + size + length_at(head));
            if (behind.empty() || (behind.size() >= 8 && has_letters(behind)))
                return head;
        }
        return Head::bare;
    }
    // True if an element with a representation begins here, or with the letters of the one at hand.
    bool has_letters(ByteView element) const {
        const char* letters = reinterpret_cast<const char*>(element.data()) + 4;
        return is_representation(letters) || std::memcmp(letters, bytes_.data() + at_ + 4, 2) == 0;
    }

    // Moves behind the end of a sequence of undefined length. False if that does not come.
    bool skip_items(bool is_unknown) {
        if (depth_ == deepest_item) {
            at_ = bytes_.size();
            return false;
        }
        while (bytes_.size() - at_ >= 8) {
            const DicomTag tag = tag_at(at_);
            const std::uint32_t length = number(at_ + 4, 4);
            if (tag == end_of_sequence) {
                at_ += 8;
                return true;
            }
            if (tag != item)
                return false;
            at_ += 8;
            if (length == undefined_length) {
                // Unknown sequences hold no representations (PS3.5, 6.2.2).
                Elements inside(bytes_.subspan(at_),
                                is_unknown ? DicomEncoding{false, false} : encoding_, depth_ + 1);
                DicomElement element;
                while (inside.next(element)) {
                }
                at_ += inside.place();
            } else {
                if (length > bytes_.size() - at_) {
                    at_ = bytes_.size();
                    return false;
                }
                at_ += length;
            }
        }
        return false;
    }

    ByteView bytes_;
    DicomEncoding encoding_;
    int depth_;
    std::size_t at_ = 0;
};

// The first element says how the others are written, also where the transfer syntax lies.
DicomEncoding encoding_of(ByteView set) {
    DicomEncoding encoding;
    if (set.size() < 8)
        return encoding;
    encoding.big_endian = set[0] == std::byte(0) && set[1] != std::byte(0);
    encoding.has_representations = is_representation(reinterpret_cast<const char*>(set.data()) + 4);
    return encoding;
}

void trim(std::string& text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0'))
        text.pop_back();
    std::size_t begin = 0;
    while (begin < text.size() && (text[begin] == ' ' || text[begin] == '\0'))
        ++begin;
    text.erase(0, begin);
}

}  // namespace

DicomSet::DicomSet(ByteView bytes, DicomEncoding encoding) : encoding_(encoding) {
    Elements elements(bytes, encoding, 0);
    DicomElement element;
    bool has_pixels = false;
    while (elements_.size() < max_elements && elements.next(element)) {
        // Bytes behind the pixels, of padding for example, say nothing about them.
        is_cut_off_ = is_cut_off_ || (element.is_cut_off && !has_pixels);
        has_pixels = has_pixels || element.tag == pixel_data_tag;
        elements_.push_back(element);
    }
    is_cut_off_ = is_cut_off_ || (!has_pixels && elements.ends_in_a_head());
}

const DicomElement* DicomSet::find(DicomTag tag) const {
    for (const DicomElement& element : elements_)
        if (element.tag == tag && !element.value.empty())
            return &element;
    return nullptr;
}

bool DicomSet::has_two_values(DicomTag tag) const {
    const DicomElement* const first = find(tag);
    return first && std::any_of(elements_.begin(), elements_.end(), [&](const DicomElement& other) {
               return other.tag == tag && !other.value.empty() &&
                      !std::equal(other.value.begin(), other.value.end(), first->value.begin(),
                                  first->value.end());
           });
}

std::string DicomSet::text(DicomTag tag, std::size_t most) const {
    const DicomElement* element = find(tag);
    if (!element || element->is_open)
        return "";
    const std::size_t size = std::min(element->value.size(), most);
    std::string text(reinterpret_cast<const char*>(element->value.data()), size);
    trim(text);
    return text;
}

int DicomSet::integer(DicomTag tag, int fallback) const {
    const DicomElement* element = find(tag);
    if (!element)
        return fallback;
    const ByteView value = element->value;
    const std::array<char, 2>& r = element->representation;
    const bool is_said = r == std::array{'U', 'S'} || r == std::array{'U', 'L'} ||
                         r == std::array{'S', 'S'} || r == std::array{'S', 'L'};
    // Two or four digits would be numbers that no field here has.
    const bool has_digits = std::any_of(value.begin(), value.end(), [](std::byte b) {
        return b >= std::byte('0') && b <= std::byte('9');
    });
    // Two or four bytes of an unknown representation are rather a number.
    const bool may_be_decimal = r == std::array{'I', 'S'} || r == std::array{'D', 'S'} ||
                                (value.size() != 2 && value.size() != 4);
    const bool is_text =
        !is_said && has_digits && std::all_of(value.begin(), value.end(), [&](std::byte b) {
            return b == std::byte(' ') || (b == std::byte('.') && may_be_decimal) ||
                   (b >= std::byte('0') && b <= std::byte('9'));
        });
    if (!is_text && (value.size() == 2 || value.size() == 4)) {
        const std::uint32_t number = number_at(value, 0, value.size(), encoding_.big_endian);
        if (r == std::array{'S', 'S'})
            return std::int16_t(number);
        return number <= 0x7fffffff ? int(number) : fallback;
    }
    std::string digits = text(tag, 16);
    // "1.0" is a whole number, too.
    if (const std::size_t point = digits.find('.');
        point != 0 && point != digits.npos &&
        digits.find_first_not_of('0', point + 1) == digits.npos)
        digits.resize(point);
    int number = fallback;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size() ? number : fallback;
}

std::vector<int> DicomSet::words(DicomTag tag, bool is_signed) const {
    std::vector<int> words;
    if (const DicomElement* element = find(tag); element && !element->is_open)
        for (std::size_t at = 0; at + 2 <= element->value.size(); at += 2) {
            const std::uint32_t word = number_at(element->value, at, 2, encoding_.big_endian);
            words.push_back(is_signed ? std::int16_t(word) : int(word));
        }
    return words;
}

std::vector<DicomSet> DicomSet::items(DicomTag tag) const {
    const DicomElement* element = find(tag);
    return element ? items(*element) : std::vector<DicomSet>();
}

std::vector<DicomSet> DicomSet::items(const DicomElement& element) const {
    std::vector<DicomSet> found;
    const ByteView value = element.value;
    const bool is_unknown = element.representation == std::array{'U', 'N'};
    const DicomEncoding inside = is_unknown ? DicomEncoding{false, false} : encoding_;
    const auto number = [&](std::size_t at, std::size_t size) {
        return number_at(value, at, size, inside.big_endian);
    };
    std::size_t at = 0;
    while (value.size() - at >= 8 && (number(at, 2) << 16 | number(at + 2, 2)) == item) {
        const std::uint32_t length = number(at + 4, 4);
        at += 8;
        if (length == undefined_length) {
            Elements elements(value.subspan(at), inside, 1);
            DicomElement ignored;
            while (elements.next(ignored)) {
            }
            found.emplace_back(value.subspan(at, elements.place()), inside);
            at += elements.place();
        } else {
            const std::size_t size = std::min<std::size_t>(length, value.size() - at);
            found.emplace_back(value.subspan(at, size), inside);
            at += size;
        }
    }
    return found;
}

std::vector<ByteView> DicomSet::fragments(const DicomElement& element, bool& is_cut_off) const {
    std::vector<ByteView> found;
    const ByteView value = element.value;
    std::size_t at = 0;
    is_cut_off = false;
    while (value.size() - at >= 8) {
        const DicomTag tag = number_at(value, at, 2, encoding_.big_endian) << 16 |
                             number_at(value, at + 2, 2, encoding_.big_endian);
        const std::uint32_t length = number_at(value, at + 4, 4, encoding_.big_endian);
        if (tag != item)
            break;
        at += 8;
        is_cut_off = length > value.size() - at;
        const std::size_t size = std::min<std::size_t>(length, value.size() - at);
        found.push_back(value.subspan(at, size));
        at += size;
    }
    return found;
}

namespace {

bool begins_with_mark(ByteView bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "DICM", 4) == 0;
}

bool has_preamble(ByteView bytes) {
    return bytes.size() >= 132 && begins_with_mark(bytes.subspan(128));
}

}  // namespace

bool begins_as_dicom(ByteView head) {
    if (has_preamble(head) || begins_with_mark(head))
        return true;
    if (head.size() < 8)
        return false;
    const bool big_endian = head[0] == std::byte(0);
    const std::uint32_t group = number_at(head, 0, 2, big_endian);
    const std::uint32_t element = number_at(head, 2, 2, big_endian);
    if ((group != 2 && group != 8) || element > 0x0100)
        return false;
    constexpr std::uint32_t longest_first = 1024;
    return is_representation(reinterpret_cast<const char*>(head.data()) + 4) ||
           number_at(head, 4, 4, big_endian) <= longest_first;
}

DicomFile parse_dicom(ByteView file, std::size_t most) {
    DicomFile parsed;
    constexpr std::byte gzip[] = {std::byte(0x1f), std::byte(0x8b)};
    if (file.size() > 2 && std::equal(std::begin(gzip), std::end(gzip), file.begin())) {
        const Unpacked unpacked = unpack(file, Packing::gzip, most);
        if (!unpacked.whole) {
            parsed.kind =
                unpacked.too_large ? DicomFile::Kind::too_large : DicomFile::Kind::damaged;
            return parsed;
        }
        parsed.unpacked = unpacked.bytes;
        file = parsed.unpacked;
    }
    if (!begins_as_dicom(file))
        return parsed;
    parsed.kind = DicomFile::Kind::good;
    // Some programs leave the preamble out, but not the mark behind it.
    const std::size_t begin = has_preamble(file) ? 132 : begins_with_mark(file) ? 4 : 0;
    const ByteView rest = file.subspan(begin);
    // Group 2 describes the file and is always little-endian.
    std::size_t end = 0;
    Elements meta(rest, {}, 0);
    DicomElement element;
    while (rest.size() - end >= 2 && rest[end] == std::byte(2) && rest[end + 1] == std::byte(0) &&
           meta.next(element))
        end = meta.place();
    parsed.transfer_syntax = DicomSet(rest.first(end), {}).text(0x00020010, 64);
    ByteView set = rest.subspan(end);
    if (set.empty()) {
        parsed.kind = DicomFile::Kind::cut_off;
        return parsed;
    }
    if (parsed.transfer_syntax == "1.2.840.10008.1.2.1.99" && !begins_as_dicom(set)) {
        Unpacked unpacked = unpack(set, Packing::deflate, most);
        if (!unpacked.whole)
            unpacked = unpack(set, Packing::zlib, most);
        if (!unpacked.whole) {
            parsed.kind =
                unpacked.too_large ? DicomFile::Kind::too_large : DicomFile::Kind::damaged;
            return parsed;
        }
        parsed.unpacked = std::move(unpacked.bytes);
        set = parsed.unpacked;
    }
    parsed.set = DicomSet(set, encoding_of(set));
    // Any bytes may begin as a DICOM file without a preamble does; its class, modality or size
    // follows in one.
    if (begin == 0 && !parsed.set.has(0x00080016) && !parsed.set.has(0x00080060) &&
        !parsed.set.has(0x00280010))
        parsed.kind = DicomFile::Kind::no_dicom;
    return parsed;
}

}  // namespace theatron::cases
