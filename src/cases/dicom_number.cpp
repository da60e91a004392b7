// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_number.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include "base/outside_text.h"
#include "base/trimmed.h"

namespace theatron::cases {
namespace {

constexpr std::string_view padding(" \0\t\r\n", 5);

template <class T>
double binary_at(ByteView bytes, std::size_t at, bool big_endian) {
    std::byte raw[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i)
        raw[i] = bytes[at + (big_endian ? sizeof(T) - 1 - i : i)];
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return double(value);
}

}  // namespace

std::optional<double> dicom_decimal(std::string_view component) {
    component = trimmed(component, padding);
    if (component.starts_with('+') && component.size() > 1 && component[1] != '-')
        component.remove_prefix(1);
    double value = 0;
    const char* const end = component.data() + component.size();
    const auto [at, error] = std::from_chars(component.data(), end, value);
    if (error != std::errc() || at != end || !std::isfinite(value))
        return std::nullopt;
    return value;
}

Field dicom_decimals(const DicomSet& set, DicomTag tag, double* out, int count) {
    const DicomElement* element = set.find(tag);
    if (!element)
        return Field::absent;
    const bool single = element->representation == std::array{'F', 'L'};
    if (single || element->representation == std::array{'F', 'D'}) {
        const std::size_t size = single ? 4 : 8;
        if (element->value.size() < size * std::size_t(count))
            return Field::bad;
        for (int i = 0; i < count; ++i) {
            const bool big = set.encoding().big_endian;
            const std::size_t at = size * std::size_t(i);
            out[i] = single ? binary_at<float>(element->value, at, big)
                            : binary_at<double>(element->value, at, big);
            if (!std::isfinite(out[i]))
                return Field::bad;
        }
        return Field::good;
    }
    const std::string list = set.text(tag);
    if (trimmed(list, padding).empty())
        return Field::absent;
    std::size_t begin = 0;
    for (int i = 0; i < count; ++i) {
        if (begin > list.size())
            return Field::bad;
        const std::size_t end = std::min(list.find('\\', begin), list.size());
        const auto value = dicom_decimal(std::string_view(list).substr(begin, end - begin));
        if (!value)
            return Field::bad;
        out[i] = *value;
        begin = end + 1;
    }
    return Field::good;
}

std::string bad_field(const DicomSet& set, DicomTag tag, std::string_view name, int count) {
    const std::string text =
        "has the " + std::string(name) + " '" + clean_text(set.text(tag), 40) + "', ";
    return text +
           (count == 1 ? std::string("which is no number of DICOM")
                       : "which is not " + std::to_string(count) + " numbers of DICOM") +
           "; export it again";
}

}  // namespace theatron::cases
