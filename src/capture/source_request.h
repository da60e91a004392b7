// SPDX-License-Identifier: Apache-2.0
// The child's side of live sources: the requests of a SourceCamera (source_camera.h), whose answers
// are VideoAnswers.
#pragma once

#include <optional>
#include <string>

#include "base/bytes.h"
#include "capture/video_answer.h"
#include "sandbox/inside.h"

namespace theatron::capture {

// `text` says what is opened, as each reader defines it. Pictures get the size `wanted`; without
// one, their own. Trusted: the parent writes it.
struct SourceOpening {
    std::string text;
    Size wanted;
    double frames_per_second = 30;
};

// Serves a Source(SourceOpening, Inside&) with VideoAnswer open(), and next(): nullopt ends the
// source. Until the channel closes.
template <class Source>
void serve_source(sandbox::Inside& inside) {
    SourceOpening opening;
    std::optional<Source> source;
    while (const std::optional<Bytes> request = inside.receive()) {
        ByteReader in(*request);
        switch (VideoRequest(in.get<std::uint8_t>())) {
            case VideoRequest::text: {
                const ByteView part = in.rest();
                opening.text.append(reinterpret_cast<const char*>(part.data()), part.size());
                break;
            }
            case VideoRequest::open:
                opening.wanted.width = in.get<std::int32_t>();
                opening.wanted.height = in.get<std::int32_t>();
                opening.frames_per_second = in.get_f64();
                source.emplace(opening, inside);
                inside.send(encode(source->open()));
                break;
            case VideoRequest::next: {
                const auto answer = source ? source->next() : std::nullopt;
                inside.send(encode(
                    answer.value_or(VideoAnswer{.kind = VideoAnswer::Kind::end, .size = {}})));
                break;
            }
        }
    }
}

}  // namespace theatron::capture
