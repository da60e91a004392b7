// SPDX-License-Identifier: Apache-2.0
// Reads an Azure Kinect recording (Matroska) with libavformat: depth as 16-bit big-endian values,
// colour as JPEG, the factory calibration as an attachment. Pictures come out as they lie in the
// file; nothing is decoded.
//
// Runs in a sandbox, since the library is large and the file is somebody else's. MkvFile is what
// the rest of the program uses.
#pragma once

#include <memory>
#include <optional>

#include "capture/mkv_answer.h"
#include "sandbox/inside.h"

namespace theatron::capture {

class MkvReader {
public:
    using Kind = MkvAnswer::Kind;

    // Reads from the beginning of the file behind `descriptor`, which stays the caller's. Functions
    // throw std::bad_alloc for want of memory and nothing else.
    explicit MkvReader(int descriptor);
    ~MkvReader();

    // Kind::description, or what is wrong with the file: then there is nothing to read.
    Kind kind() const { return kind_; }
    const MkvDescription& description() const;

    struct Picture {
        Kind kind{};  // depth or color
        Duration time{};
        ByteView bytes;  // until the next call
    };
    // The next picture, nothing at the end.
    std::optional<Picture> read();

    // Answers the requests of an MkvFile until there are no more.
    static void serve(sandbox::Inside& inside);

private:
    struct Library;
    std::unique_ptr<Library> library_;
    Kind kind_;
};

// For run_as_child(): what cameras need.
inline constexpr sandbox::Reader foreign_readers[] = {
    {"mkv", sandbox::Profile::file, MkvReader::serve}};

}  // namespace theatron::capture
