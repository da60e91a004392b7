// SPDX-License-Identifier: Apache-2.0
// The cameras that a participant sends.
#include <algorithm>

#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "client/participant_shared.h"
#include "wire/sentence.h"

namespace theatron::client {
namespace {

// Frames that wait for the participant's thread; one more is dropped.
constexpr std::size_t max_media_waiting = 64;

}  // namespace

void Participant::publish(std::vector<wire::OfferedCamera> cameras) {
    const std::lock_guard lock(shared_->mutex);
    shared_->offers[std::size_t(Offer::cameras)] = std::move(cameras);
    if (shared_->client)
        shared_->client->post([this] { offer_cameras(Offer::cameras); });
}

void Participant::publish_face(std::optional<wire::OfferedCamera> face) {
    set_offer(Offer::face, std::move(face));
}

void Participant::show_screen(std::optional<wire::OfferedCamera> screen) {
    set_offer(Offer::screen, std::move(screen));
}

void Participant::set_offer(Offer which, std::optional<wire::OfferedCamera> camera) {
    const std::lock_guard lock(shared_->mutex);
    auto& offer = shared_->offers[std::size_t(which)];
    offer.clear();
    if (camera)
        offer.push_back(std::move(*camera));
    problem_of(which).clear();
    if (shared_->client)
        shared_->client->post([this, which] { offer_cameras(which); });
}

// The mutex is held.
std::string& Participant::problem_of(Offer offer) const {
    switch (offer) {
        case Offer::face:
            return shared_->status.face_problem;
        case Offer::screen:
            return shared_->status.screen_problem;
        case Offer::cameras:
            break;
    }
    return shared_->status.publish_problem;
}

// Frames have session times, so the clock comes first.
void Participant::offer_cameras(Offer what) {
    wire::Publish offer;
    {
        const std::lock_guard lock(shared_->mutex);
        if (!session_.joined() || !shared_->status.clock_known)
            return;
        offer.cameras = shared_->offers[std::size_t(what)];
    }
    take_back(std::exchange(numbers(what), {}));
    if (offer.cameras.empty())
        return;
    if (what == Offer::cameras && !session_.may_publish())
        return refuse_cameras(what, {wire::TextCode::link_without_cameras});
    if (what == Offer::face && !session_.has(wire::Feature::webcam))
        return refuse_cameras(what, {wire::TextCode::host_without_faces});
    if (what == Offer::screen && !session_.has(wire::Feature::shows_screen))
        return refuse_cameras(what, {wire::TextCode::host_without_screens});
    offered_.push_back(what);
    shared_->client->send_control(wire::encode(offer));
}

void Participant::offer_all() {
    for (const Offer offer : all_offers)
        offer_cameras(offer);
}

void Participant::withdraw() {
    for (const Offer offer : all_offers)
        take_back(std::exchange(numbers(offer), {}));
}

void Participant::take_back(std::vector<CameraId> cameras) {
    if (!cameras.empty())
        shared_->client->send_control(wire::encode(wire::Unpublish{std::move(cameras)}));
}

void Participant::forget_numbers(Offer offer) {
    numbers(offer).clear();
    if (events(offer).published)
        events(offer).published({});
}

void Participant::refuse_cameras(Offer offer, const wire::Text& why) {
    const std::string problem = wire::sentence(why);
    {
        const std::lock_guard lock(shared_->mutex);
        problem_of(offer) = clean_text(problem, max_remark_characters);
    }
    remark(problem);
}

// The host answers in order.
void Participant::on_published() {
    if (offered_.empty())
        return;
    const Offer offer = offered_.front();
    offered_.pop_front();
    const wire::Published& answer = session_.published();
    if (!answer.problem.empty())
        refuse_cameras(offer, answer.problem);
    // A newer offer has been sent: these cameras are withdrawn, since nobody knows them here.
    if (std::find(offered_.begin(), offered_.end(), offer) != offered_.end())
        return take_back(answer.cameras);
    bool is_wanted = false;
    {
        const std::lock_guard lock(shared_->mutex);
        is_wanted = !shared_->offers[std::size_t(offer)].empty();
    }
    if (!is_wanted)
        return take_back(answer.cameras);
    numbers(offer) = answer.cameras;
    if (events(offer).published)
        events(offer).published(numbers(offer));
}

void Participant::on_share_ended() {
    for (const Offer offer : {Offer::cameras, Offer::screen})
        end_offered(offer, session_.share_ended());
}

void Participant::end_offered(Offer offer, const wire::ShareEnded& message) {
    std::vector<CameraId>& own = numbers(offer);
    std::vector<CameraId> ended;
    for (const CameraId camera : message.cameras) {
        const auto found = std::find(own.begin(), own.end(), camera);
        if (found == own.end())
            continue;
        std::string name;
        {
            // Offers have the order of their numbers.
            const std::lock_guard lock(shared_->mutex);
            auto& offered = shared_->offers[std::size_t(offer)];
            const auto place = found - own.begin();
            if (place < std::ptrdiff_t(offered.size())) {
                name = offered[std::size_t(place)].name;
                offered.erase(offered.begin() + place);
            }
        }
        own.erase(found);
        ended.push_back(camera);
        remark(say(Phrase::share_ended, message.by, name));
    }
    if (!ended.empty() && events(offer).ended)
        events(offer).ended(ended);
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
    const CameraId camera = camera_of(header.stream);
    if (std::none_of(numbers_.begin(), numbers_.end(), [&](const auto& own) {
            return std::find(own.begin(), own.end(), camera) != own.end();
        }))
        return;
    // An outbox keeps one chain of frames for each stream; here each setting of a stream is one,
    // and its number is unique in the session.
    const auto chain = StreamId(std::uint16_t(header.setting));
    net::Media media{std::move(message), chain,
                     header.setting,     header.frame,
                     header.reference,   header.temporal_layer,
                     header.key,         {}};
    const auto pushed = shared_->client->send_media(std::move(media));
    if (pushed.dropped > 0) {
        const std::lock_guard lock(shared_->mutex);
        shared_->status.media_dropped += std::uint64_t(pushed.dropped);
    }
    if (pushed.needs_key)
        missing_keys_.request({header.stream, header.setting});
}

// Each publisher knows its own cameras.
void Participant::on_encode() {
    for (const Offer offer : all_offers)
        if (events(offer).encode)
            events(offer).encode(session_.encode().settings);
}

void Participant::on_encode_key(StreamId stream, SettingId setting) {
    for (const Offer offer : all_offers)
        if (events(offer).encode_key)
            events(offer).encode_key(stream, setting);
}

void Participant::on_encode_keys() {
    {
        const std::lock_guard lock(shared_->mutex);
        for (const auto& [stream, setting] : std::exchange(shared_->broken, {}))
            missing_keys_.request({stream, setting});
    }
    for (const auto& key : missing_keys_.take(steady_now()))
        on_encode_key(key.stream, key.setting);
}

void Participant::tell_camera(const wire::CameraState& state) {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->client)
        shared_->client->post(
            [this, state] { shared_->client->send_control(wire::encode(wire::ToHost(state))); });
}

}  // namespace theatron::client
