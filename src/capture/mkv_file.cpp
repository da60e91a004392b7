// SPDX-License-Identifier: Apache-2.0
#include "capture/mkv_file.h"

#include <utility>

#include "base/error.h"
#include "capture/cut_off.h"
#include "capture/readable_file.h"
#include "ffmpeg/ffmpeg.h"
#include "sandbox/child.h"

namespace theatron::capture {
namespace {

using Kind = MkvAnswer::Kind;

}  // namespace

struct MkvFile::Process {
    Process(const std::filesystem::path& path, const sandbox::Limits& limits)
        : file(path),
          child(ffmpeg::needed_by("mkv"), file.descriptor(), "the file " + quoted(path), limits) {}

    void request(MkvRequest what) {
        const auto message = std::byte(what);
        child.send({&message, 1});
        waiting = true;
    }

    MkvAnswer answer() {
        waiting = false;
        const auto answer = decode_mkv_answer(child.receive(), child.area().size());
        if (!answer)
            child.refuse("one that is " + std::string(to_text(answer.error())));
        return *answer;
    }

    // The shared memory may change at any time: all checks and uses are on this copy.
    Bytes copy(const MkvAnswer& answer) const {
        const ByteView bytes = child.area().first(answer.bytes);
        return {bytes.begin(), bytes.end()};
    }

    ReadableFile file;
    sandbox::Child child;
    bool waiting = false;  // an answer is outstanding
};

MkvFile::MkvFile(const std::filesystem::path& path, const sandbox::Limits& limits)
    : path_(path),
      process_(std::make_unique<Process>(path, limits)),
      cut_off_(capture::is_cut_off(process_->file.descriptor(), process_->file.bytes())),
      description_(open()) {}

MkvFile::~MkvFile() = default;

MkvDescription MkvFile::open() {
    process_->request(MkvRequest::open);
    const MkvAnswer answer = process_->answer();
    switch (answer.kind) {
        case Kind::no_matroska:
            throw Error(quoted(path_) +
                        " is not a Matroska recording, or is damaged at its beginning.");
        case Kind::no_depth:
            throw Error(quoted(path_) +
                        " has no depth track, so it is not an Azure Kinect recording, or is "
                        "damaged at its beginning; what Theatron recorded is recording:FILE.");
        case Kind::infrared_only:
            throw Error(quoted(path_) +
                        " has infrared only and no depth, as an Azure Kinect records in its mode "
                        "PASSIVE_IR; Theatron needs a recording with depth.");
        case Kind::impossible_size:
            throw Error(quoted(path_) + " has depth of an impossible size.");
        case Kind::description:
            break;
        default:
            process_->child.refuse("a picture before the description");
    }
    auto description = decode_mkv_description(process_->copy(answer));
    if (!description)
        process_->child.refuse("a description that is " +
                               std::string(to_text(description.error())));
    // From here on the reader is always one picture ahead.
    process_->request(MkvRequest::next);
    return std::move(*description);
}

std::optional<MkvFile::Packet> MkvFile::read() {
    if (!process_->waiting)
        return std::nullopt;
    const MkvAnswer answer = process_->answer();
    if (answer.kind == Kind::end)
        return std::nullopt;
    if (answer.kind != Kind::depth && answer.kind != Kind::color)
        process_->child.refuse("no picture");
    Packet packet{answer.kind == Kind::depth ? Packet::Track::depth : Packet::Track::color,
                  answer.time, process_->copy(answer)};
    process_->request(MkvRequest::next);
    return packet;
}

void MkvFile::rewind() {
    if (process_->waiting)
        (void)process_->answer();
    const MkvDescription again = open();
    if (again.depth != description_.depth || again.color != description_.color)
        throw Error(quoted(path_) + " has changed while it was played.");
}

}  // namespace theatron::capture
