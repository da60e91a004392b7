// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. What is accepted encodes again to something that decodes
// to the same, within the stated memory, however often the input's tables share their parts.
#include <cstdlib>

#include "base/outside_text.h"
#include "wire/control.h"

namespace {

using namespace theatron;

// Bytes that a message holds beside its own struct; counts its texts' and lists' sizes.
struct Measure {
    std::size_t bytes = 0;
    void operator()(const std::string& text) {
        if (clean_text(text, text.size()) != text)
            std::abort();
        bytes += text.size();
    }
    void operator()(const wire::Join& m) {
        for (const auto* text : {&m.token, &m.name, &m.depth_codec, &m.color_codec})
            (*this)(*text);
    }
    void operator()(const wire::ChooseCodecs& m) {
        (*this)(m.depth_codec);
        (*this)(m.color_codec);
    }
    void operator()(const wire::Report& m) {
        bytes += m.streams.size() * sizeof(wire::StreamReport);
        (*this)(m.renderer);
    }
    void operator()(const wire::Welcome& m) {
        (*this)(m.host_name);
        for (const wire::Camera& camera : m.cameras) {
            bytes += sizeof(camera) + camera.calibration.size();
            (*this)(camera.name);
        }
    }
    void operator()(const wire::Refused& m) { (*this)(m.reason); }
    void operator()(const wire::Settings& m) {
        (*this)(m.note);
        for (const wire::StreamSetting& setting : m.settings) {
            bytes += sizeof(setting);
            (*this)(setting.codec);
        }
    }
    void operator()(const wire::CameraState& m) {
        (*this)(m.problem);
        (*this)(m.filter);
    }
    void operator()(const wire::Delivery& m) {
        (*this)(m.what);
        (*this)(m.reason);
    }
    void operator()(const wire::SetRenderer& m) { (*this)(m.renderer); }
    void operator()(const wire::Goodbye& m) { (*this)(m.reason); }
    template <class Plain>
    void operator()(const Plain&) {}
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto message = wire::decode_control(std::as_bytes(std::span(data, size)));
    if (!message)
        return 0;
    Measure measure;
    std::visit(measure, *message);
    if (measure.bytes > wire::max_decoded_size)
        std::abort();
    const Bytes encoded = wire::encode_control(*message);
    const auto again = wire::decode_control(encoded);
    if (!again || again->index() != message->index() || wire::encode_control(*again) != encoded)
        std::abort();
    return 0;
}
