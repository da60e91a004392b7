// SPDX-License-Identifier: Apache-2.0
// The file of a rendered loop: magic, key, number of frames; for each frame two lengths, the RVL
// depth and the JPEG colour; at the end a checksum of all bytes before it. The key covers
// everything that changes the pictures.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "image/frame.h"
#include "image/image.h"
#include "synthetic/frame_maker.h"

namespace theatron::synthetic {

// The place of a frame in the file.
struct LoopEntry {
    std::uint64_t at = 0;  // file offset of the depth bytes, which the colour bytes follow
    std::uint32_t depth_bytes = 0, color_bytes = 0;
};

// Detects accidental damage, not manipulation.
class Checksum {
public:
    void add(ByteView bytes);
    std::uint64_t value() const { return sum_; }

private:
    void step(std::uint64_t v);
    std::uint64_t sum_ = 0x243f6a8885a308d3u;
};

// A draft, which becomes the file when it is whole. One thread at a time. All functions throw Error
// where the disk cannot be written.
class LoopWriter {
public:
    // Makes the folder. Another process may render the same loop: each writes a draft of its own,
    // and the last one stays.
    LoopWriter(std::filesystem::path path, const std::string& key, std::size_t frames);
    // Removes the draft if it did not become the file.
    ~LoopWriter();
    LoopWriter(const LoopWriter&) = delete;
    LoopWriter& operator=(const LoopWriter&) = delete;

    const std::filesystem::path& draft() const { return draft_; }
    // The frame can be read from the draft afterwards.
    LoopEntry add(const EncodedFrame& frame);
    void finish();

private:
    void add_bytes(ByteView bytes);
    void add_number(std::uint32_t value);
    void require_good() const;

    std::filesystem::path path_, draft_;
    std::ofstream out_;
    Checksum sum_;
    std::uint64_t written_ = 0;
};

// The frames of a whole file; nullopt if there is none, or one with another key or damaged.
std::optional<std::vector<LoopEntry>> read_loop_index(const std::filesystem::path& path,
                                                      const std::string& key);

// Reads a frame into `out`, whose memory is reused; `depth` and `color` are the pictures' sizes.
// False if it is damaged.
bool read_loop_frame(std::ifstream& file, const LoopEntry& entry, Size depth, Size color,
                     Bytes& buffer, Frame& out);

}  // namespace theatron::synthetic
