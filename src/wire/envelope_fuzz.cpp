// SPDX-License-Identifier: Apache-2.0
// Any sequence of envelopes (each behind a two-byte length): unwrapping and
// header parsing stay inside their input, and where only control is taken no media comes out.
#include <cstdlib>

#include "wire/envelope.h"
#include "wire/face_expression.h"
#include "wire/own_face.h"
#include "wire/person_pose.h"

namespace {

using namespace theatron;

// An expression that is read has one encoding, and its values are shares.
void check_expression(ByteView body) {
    const auto expression = wire::decode_face_expression(body);
    if (!expression)
        return;
    const Bytes again = wire::encode_face_expression(*expression);
    if (again != Bytes(body.begin(), body.end()))
        std::abort();
}

void check_own_face(ByteView body) {
    const auto face = wire::decode_own_face(body);
    if (face && wire::encode_own_face(*face) != Bytes(body.begin(), body.end()))
        std::abort();
}

// States, voice and acknowledgements have one encoding: writing them again gives equal bytes.
void check_same_bytes(const wire::Unwrapper::Unwrapped& got, const Bytes& envelope) {
    Bytes again;
    wire::StateReader reader(got.states);
    for (wire::State state; reader.next(state);) {
        if (!wire::append_state(state, again))
            std::abort();
        (void)wire::decode_person_pose(state.body);
        check_expression(state.body);
        check_own_face(state.body);
    }
    if (got.voice)
        wire::wrap_voice(*got.voice, again);
    if (got.acknowledgement)
        wire::wrap_acknowledgement(*got.acknowledgement, again);
    if (!again.empty() && again != envelope)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(std::as_bytes(std::span(data, size)));
    wire::Unwrapper unwrapper, host(wire::Unwrapper::Takes::all_but_media);
    while (!in.rest().empty()) {
        const std::size_t length = in.get<std::uint16_t>();
        // An exact copy, so that a read past the end is seen.
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        const Bytes envelope(part.begin(), part.end());
        if (const auto taken = host.take(envelope); taken && (taken->is_media || taken->media))
            std::abort();
        const auto got = unwrapper.take(envelope);
        if (!got)
            return 0;
        if (got->media)
            (void)wire::parse_media_header(*got->media);
        check_same_bytes(*got, envelope);
    }
    return 0;
}
