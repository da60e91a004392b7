// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_writer.h"

#include <cassert>
#include <cstdio>
#include <initializer_list>
#include <string_view>

namespace theatron::cases {
namespace {

constexpr std::string_view ct_image_storage = "1.2.840.10008.5.1.4.1.1.2";
constexpr std::string_view explicit_little_endian = "1.2.840.10008.1.2.1";
// Derived from a UUID, as DICOM allows (PS3.5, B.2).
constexpr std::string_view implementation = "2.25.305828488182831875890203105390285383139";

class Elements {
public:
    void text(std::uint16_t group, std::uint16_t element, const char (&vr)[3],
              std::string_view value) {
        const bool uid = vr[0] == 'U';
        std::string padded(value);
        if (padded.size() % 2)
            padded += uid ? '\0' : ' ';
        head(group, element, vr);
        writer_.put(std::uint16_t(padded.size()));
        writer_.put_bytes(as_bytes(padded));
    }
    void number(std::uint16_t group, std::uint16_t element, std::uint16_t value) {
        head(group, element, "US");
        writer_.put(std::uint16_t(2));
        writer_.put(value);
    }
    void decimals(std::uint16_t group, std::uint16_t element,
                  std::initializer_list<double> values) {
        std::string list;
        for (const double value : values) {
            // DS has at most 16 characters.
            char text_of_value[32];
            std::snprintf(text_of_value, sizeof(text_of_value), "%.6f", value);
            list += (list.empty() ? "" : "\\") + std::string(text_of_value);
        }
        text(group, element, "DS", list);
    }
    // OB, OW: two more bytes, and 32 bits for the length.
    void bytes(std::uint16_t group, std::uint16_t element, const char (&vr)[3], ByteView value) {
        head(group, element, vr);
        writer_.put(std::uint16_t(0));
        writer_.put(std::uint32_t(value.size()));
        writer_.put_bytes(value);
    }
    Bytes take() { return std::move(out_); }

private:
    void head(std::uint16_t group, std::uint16_t element, const char (&vr)[3]) {
        writer_.put(group);
        writer_.put(element);
        writer_.put_bytes(as_bytes(std::string_view(vr, 2)));
    }

    Bytes out_;
    ByteWriter writer_{out_};
};

Bytes meta_information(const DicomTexts& texts) {
    Elements elements;
    const std::byte version[2] = {std::byte(0), std::byte(1)};
    elements.bytes(0x0002, 0x0001, "OB", version);
    elements.text(0x0002, 0x0002, "UI", ct_image_storage);
    elements.text(0x0002, 0x0003, "UI", texts.instance_uid);
    elements.text(0x0002, 0x0010, "UI", explicit_little_endian);
    elements.text(0x0002, 0x0012, "UI", implementation);
    return elements.take();
}

}  // namespace

Bytes write_dicom(const DicomSlice& slice, const DicomTexts& texts) {
    assert(slice.samples.size() == std::size_t(slice.columns) * std::size_t(slice.rows));
    Elements e;
    e.text(0x0008, 0x0008, "CS", "DERIVED\\SECONDARY\\AXIAL");
    e.text(0x0008, 0x0016, "UI", ct_image_storage);
    e.text(0x0008, 0x0018, "UI", texts.instance_uid);
    e.text(0x0008, 0x0060, "CS", slice.modality);
    e.text(0x0008, 0x103e, "LO", texts.series_description);
    e.text(0x0010, 0x0010, "PN", texts.patient_name);
    e.text(0x0010, 0x0020, "LO", texts.patient_id);
    if (!texts.birth_date.empty())
        e.text(0x0010, 0x0030, "DA", texts.birth_date);
    if (!texts.birth_name.empty())
        e.text(0x0010, 0x1005, "PN", texts.birth_name);
    e.text(0x0012, 0x0062, "CS", slice.deidentified ? "YES" : "NO");
    e.text(0x0020, 0x000d, "UI", texts.study_uid);
    e.text(0x0020, 0x000e, "UI", slice.series_uid);
    e.text(0x0020, 0x0013, "IS", std::to_string(texts.instance));
    e.decimals(0x0020, 0x0032, {slice.position_mm.x, slice.position_mm.y, slice.position_mm.z});
    e.decimals(
        0x0020, 0x0037,
        {slice.right.x, slice.right.y, slice.right.z, slice.down.x, slice.down.y, slice.down.z});
    e.text(0x0020, 0x0052, "UI", slice.frame_uid);
    e.number(0x0028, 0x0002, 1);
    e.text(0x0028, 0x0004, "CS", slice.inverted ? "MONOCHROME1" : "MONOCHROME2");
    e.number(0x0028, 0x0010, std::uint16_t(slice.rows));
    e.number(0x0028, 0x0011, std::uint16_t(slice.columns));
    e.decimals(0x0028, 0x0030, {slice.row_spacing_mm, slice.column_spacing_mm});
    e.number(0x0028, 0x0100, 16);
    e.number(0x0028, 0x0101, 16);
    e.number(0x0028, 0x0102, 15);
    e.number(0x0028, 0x0103, 1);
    if (slice.has_window) {
        e.decimals(0x0028, 0x1050, {slice.window.center});
        e.decimals(0x0028, 0x1051, {slice.window.width});
    }
    e.decimals(0x0028, 0x1052, {slice.intercept});
    e.decimals(0x0028, 0x1053, {slice.slope});
    Bytes pixels(2 * slice.samples.size());
    for (std::size_t i = 0; i < slice.samples.size(); ++i)
        store_le(pixels.data() + 2 * i, slice.samples[i]);
    e.bytes(0x7fe0, 0x0010, "OW", pixels);

    const Bytes meta = meta_information(texts);
    Bytes file(128);
    ByteWriter writer(file);
    writer.put_bytes(as_bytes("DICM"));
    writer.put(std::uint16_t(0x0002));
    writer.put(std::uint16_t(0x0000));
    writer.put_bytes(as_bytes("UL"));
    writer.put(std::uint16_t(4));
    writer.put(std::uint32_t(meta.size()));
    writer.put_bytes(meta);
    writer.put_bytes(e.take());
    return file;
}

}  // namespace theatron::cases
