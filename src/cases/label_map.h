// SPDX-License-Identifier: Apache-2.0
// Label maps: volumes whose samples say to which organ they belong, as segmentation programs write
// them, NIfTI (.nii, .nii.gz, .hdr with .img; versions 1 and 2) and NRRD (.nrrd, .nhdr, .seg.nrrd
// of 3D Slicer).
//
// Reading is safe for any bytes and bounded: compressed content is unpacked only as far as the
// header announces, and a header may not announce more than its file can hold. Nothing throws but
// std::bad_alloc.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "medical/volume.h"

namespace theatron::cases {

inline constexpr std::size_t max_label_samples = std::size_t(1) << 28;
inline constexpr std::size_t max_labels = 256;
inline constexpr std::size_t max_label_layers = 64;

struct LabelName {
    int value = 0;
    std::string name;
    bool operator==(const LabelName&) const = default;
};

struct LabelMap {
    medical::VolumeGrid grid;           // LPS, millimetres
    std::vector<std::uint16_t> labels;  // grid.size(); 0: nothing
    std::vector<LabelName> names;       // of those labels that the file names
};

// A label map understood, or what is wrong, as the end of a sentence that begins with the file's
// name ("is no NIfTI file").
struct ParsedLabels {
    LabelMap value;
    std::string problem;  // empty if `value` holds
    // The problem: the file is whole, but nothing that is imported, such as an image.
    bool is_other_content = false;
    std::size_t layers = 1;
};

// Also compressed. `samples`: the content of the other file of a pair, whose head `file` is.
ParsedLabels parse_nifti(ByteView file, ByteView samples = {});
// The file is the head of a pair (.hdr, .img) and not one of Analyze 7.5, whose name is the same.
bool is_nifti_head(ByteView file);

// A file of 3D Slicer may hold several layers of segments that overlap; `value` is one of them.
// `data`: the content of the file that detached_data_of() names, if it names one.
ParsedLabels parse_nrrd(ByteView file, std::size_t layer = 0, ByteView data = {});

// The name of the file in which the samples of an NRRD header lie; empty if they follow it.
std::string detached_data_of(ByteView file);

// True if the samples are those of an image: very many values, of which neighbours mostly differ.
bool looks_like_an_image(const LabelMap& map);

}  // namespace theatron::cases
