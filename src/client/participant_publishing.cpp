// SPDX-License-Identifier: Apache-2.0
// The cameras that a participant sends.
#include <algorithm>

#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "client/participant_shared.h"

namespace theatron::client {
namespace {

// Frames that wait for the participant's thread; one more is dropped.
constexpr std::size_t max_media_waiting = 64;

}  // namespace

void Participant::publish(std::vector<wire::OfferedCamera> cameras) {
    const std::lock_guard lock(shared_->mutex);
    shared_->offers = std::move(cameras);
    if (shared_->client)
        shared_->client->post([this] { offer_cameras(); });
}

// Frames have session times, so the clock comes first.
void Participant::offer_cameras() {
    wire::Publish offer;
    {
        const std::lock_guard lock(shared_->mutex);
        if (!session_.joined() || !shared_->status.clock_known)
            return;
        offer.cameras = shared_->offers;
    }
    if (!numbers_.empty())
        shared_->client->send_control(wire::encode(wire::Unpublish{std::exchange(numbers_, {})}));
    if (!offer.cameras.empty() && !session_.may_publish())
        refuse_cameras({wire::TextCode::link_without_cameras});
    else if (!offer.cameras.empty())
        shared_->client->send_control(wire::encode(offer));
}

void Participant::refuse_cameras(const wire::Text& why) {
    const std::string problem = wire::english(why);
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->status.publish_problem = clean_text(problem, max_remark_characters);
    }
    remark(problem);
}

void Participant::on_published() {
    const wire::Published& answer = session_.published();
    if (!answer.problem.empty())
        refuse_cameras(answer.problem);
    numbers_ = answer.cameras;
    if (options_.publishing.published)
        options_.publishing.published(numbers_);
}

void Participant::on_share_ended() {
    const wire::ShareEnded& message = session_.share_ended();
    std::vector<CameraId> ended;
    for (const CameraId camera : message.cameras) {
        const auto found = std::find(numbers_.begin(), numbers_.end(), camera);
        if (found == numbers_.end())
            continue;
        std::string name;
        {
            // Offers have the order of their numbers.
            const std::lock_guard lock(shared_->mutex);
            const auto offer = found - numbers_.begin();
            if (offer < std::ptrdiff_t(shared_->offers.size())) {
                name = shared_->offers[std::size_t(offer)].name;
                shared_->offers.erase(shared_->offers.begin() + offer);
            }
        }
        numbers_.erase(found);
        ended.push_back(camera);
        remark(message.by + " has ended the share of \"" + name + "\".");
    }
    if (!ended.empty() && options_.publishing.ended)
        options_.publishing.ended(ended);
}

void Participant::send_media(const wire::MediaHeader& header,
                             std::shared_ptr<const Bytes> message) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client)
        return;
    if (shared_->media_waiting == max_media_waiting) {
        shared_->broken.insert({header.stream, header.setting});
        ++shared_->status.media_dropped;
        return;
    }
    ++shared_->media_waiting;
    shared_->client->post([this, header, message = std::move(message)]() mutable {
        push_media(header, std::move(message));
    });
}

void Participant::push_media(const wire::MediaHeader& header,
                             std::shared_ptr<const Bytes> message) {
    {
        const std::lock_guard lock(shared_->mutex);
        --shared_->media_waiting;
    }
    // The camera belongs to an earlier connection, or has left.
    if (std::find(numbers_.begin(), numbers_.end(), camera_of(header.stream)) == numbers_.end())
        return;
    // An outbox keeps one chain of frames for each stream; here each setting of a stream is one,
    // and its number is unique in the session.
    const auto chain = StreamId(std::uint16_t(header.setting));
    const auto pushed = shared_->client->send_media({std::move(message),
                                                     chain,
                                                     header.setting,
                                                     header.frame,
                                                     header.reference,
                                                     header.temporal_layer,
                                                     header.key,
                                                     {}});
    if (pushed.dropped > 0) {
        const std::lock_guard lock(shared_->mutex);
        shared_->status.media_dropped += std::uint64_t(pushed.dropped);
    }
    if (pushed.needs_key)
        missing_keys_.request({header.stream, header.setting});
}

void Participant::on_encode_keys() {
    {
        const std::lock_guard lock(shared_->mutex);
        for (const auto& [stream, setting] : std::exchange(shared_->broken, {}))
            missing_keys_.request({stream, setting});
    }
    for (const auto& key : missing_keys_.take(steady_now()))
        if (options_.publishing.encode_key)
            options_.publishing.encode_key(key.stream, key.setting);
}

void Participant::tell_camera(const wire::CameraState& state) {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->client)
        shared_->client->post(
            [this, state] { shared_->client->send_control(wire::encode(wire::ToHost(state))); });
}

}  // namespace theatron::client
