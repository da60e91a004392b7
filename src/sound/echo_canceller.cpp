// SPDX-License-Identifier: Apache-2.0
#include "sound/echo_canceller.h"

#include <webrtc/modules/audio_processing/include/audio_processing.h>

#include <array>
#include <mutex>
#include <vector>

#include "base/error.h"
#include "voice/packet.h"

namespace theatron::sound {
namespace {

// The library finds the delay of the echo by itself; it wants to be told one nevertheless.
constexpr int told_delay_ms = 40;

void require(int result) {
    if (result != webrtc::AudioProcessing::kNoError)
        throw Error("The library that cancels echo does not work here (error " +
                    std::to_string(result) + "); speak with --echo-cancellation off.");
}

}  // namespace

struct EchoCanceller::Parts {
    std::unique_ptr<webrtc::AudioProcessing> apm;
    const webrtc::StreamConfig stream{voice::sample_rate, 1};
    // Played samples wait for a whole block; the other thread's only.
    std::vector<float> played;
};

EchoCanceller::EchoCanceller() : parts_(std::make_unique<Parts>()) {
    webrtc::Config config;
    config.Set<webrtc::ExtendedFilter>(new webrtc::ExtendedFilter(true));
    config.Set<webrtc::DelayAgnostic>(new webrtc::DelayAgnostic(true));
    parts_->apm.reset(webrtc::AudioProcessing::Create(config));
    webrtc::AudioProcessing* const apm = parts_->apm.get();
    if (!apm)
        require(-1);
    const webrtc::ProcessingConfig formats{
        {parts_->stream, parts_->stream, parts_->stream, parts_->stream}};
    require(apm->Initialize(formats));
    require(apm->high_pass_filter()->Enable(true));
    webrtc::EchoCancellation* const echo = apm->echo_cancellation();
    require(echo->enable_drift_compensation(false));
    require(echo->set_suppression_level(webrtc::EchoCancellation::kModerateSuppression));
    require(echo->enable_metrics(true));
    require(echo->Enable(true));
    require(apm->noise_suppression()->set_level(webrtc::NoiseSuppression::kModerate));
    require(apm->noise_suppression()->Enable(true));
    require(apm->gain_control()->set_mode(webrtc::GainControl::kAdaptiveDigital));
    require(apm->gain_control()->Enable(true));
}

EchoCanceller::~EchoCanceller() = default;

void EchoCanceller::played(std::span<const float> samples) {
    std::vector<float>& waiting = parts_->played;
    waiting.insert(waiting.end(), samples.begin(), samples.end());
    std::size_t done = 0;
    for (; waiting.size() - done >= block; done += block) {
        float* const channel = waiting.data() + done;
        (void)parts_->apm->ProcessReverseStream(&channel, parts_->stream, parts_->stream, &channel);
    }
    waiting.erase(waiting.begin(), waiting.begin() + std::ptrdiff_t(done));
}

void EchoCanceller::clean(std::span<float, block> samples) {
    float* const channel = samples.data();
    (void)parts_->apm->set_stream_delay_ms(told_delay_ms);
    (void)parts_->apm->ProcessStream(&channel, parts_->stream, parts_->stream, &channel);
}

double EchoCanceller::echo_return_loss_enhancement_db() const {
    webrtc::EchoCancellation::Metrics metrics;
    if (parts_->apm->echo_cancellation()->GetMetrics(&metrics) != 0)
        return 0;
    return metrics.echo_return_loss_enhancement.instant;
}

}  // namespace theatron::sound
