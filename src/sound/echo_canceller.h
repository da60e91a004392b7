// SPDX-License-Identifier: Apache-2.0
// Cleans a microphone's samples: takes out what the loudspeaker plays, noise, and differences of
// loudness, by the WebRTC audio processing library.
#pragma once

#include <memory>
#include <span>

namespace theatron::sound {

// The two calls may come from different threads; each from one at a time.
class EchoCanceller {
public:
    // Samples that one call takes: 10 ms at 48 kHz.
    static constexpr std::size_t block = 480;

    // Throws Error if the library does not work here.
    EchoCanceller();
    ~EchoCanceller();

    // The loudspeaker is to play these samples next, any number of them, -1 to 1.
    void played(std::span<const float> samples);
    // Cleans a block of the microphone, in place.
    void clean(std::span<float, block> samples);

    // How much weaker the echo is behind the canceller than before, in dB, as the library measures
    // it; 0 while it does not know.
    double echo_return_loss_enhancement_db() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::sound
