// SPDX-License-Identifier: Apache-2.0
#include "client/participant.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/fault.h"
#include "base/outside_text.h"
#include "base/random_number.h"
#include "base/steady_clock.h"
#include "client/host_person.h"
#include "client/participant_figures.h"
#include "client/participant_shared.h"
#include "wire/envelope.h"
#include "wire/sentence.h"

namespace theatron::client {
namespace {

std::vector<wire::Feature> features_of(const Participant::Options& options) {
    std::vector<wire::Feature> features{wire::Feature::adjusting, wire::Feature::playback,
                                        wire::Feature::screens, wire::Feature::look_back};
    if (options.publishing.published)
        features.push_back(wire::Feature::publish);
    if (options.sends_only)
        features.push_back(wire::Feature::sends_only);
    if (options.keeps_room)
        features.push_back(wire::Feature::room);
    if (options.keeps_cases)
        features.push_back(wire::Feature::cases);
    if (options.shows_patient)
        features.insert(features.end(), {wire::Feature::patient, wire::Feature::asks_patient});
    features.push_back(wire::Feature::voice_consent);
    if (options.takes_faces || options.face.published)
        features.push_back(wire::Feature::webcam);
    if (options.screen.published)
        features.push_back(wire::Feature::shows_screen);
    if (options.knows_studies)
        features.push_back(wire::Feature::study);
    if (options.shows_chat)
        features.push_back(wire::Feature::chat);
    if (options.draws_flat)
        features.push_back(wire::Feature::draws_flat);
    if (options.by_relay && RelayReception::is_possible())
        features.push_back(wire::Feature::relay);
    return features;
}

}  // namespace

Participant::Participant(Options options)
    : options_(std::move(options)),
      session_({options_.link.token, options_.name, options_.depth_codec, options_.color_codec,
                options_.delivery, options_.records, features_of(options_),
                person_for_host(options_.person, options_.link),
                // Its connections have one number, so that the host knows them as its own.
                options_.run ? options_.run : random_number()}),
      shared_(std::make_unique<Shared>()),
      relay_reception_(options_.by_relay ? std::make_unique<RelayReception>(relay_events())
                                         : nullptr),
      decoders_(std::make_unique<Decoders>(decoded_events())),
      attempts_(options_.is_page, options_.records || options_.sends_only
                                      ? std::nullopt
                                      : std::optional(return_patience)) {
    shared_->status.goal = options_.delivery;
    shared_->voice_may_record = options_.voice_may_record;
    shared_->chat = options_.chat;
    if (options_.raises_hand)
        shared_->hand_wish = true;
    if (options_.keeps_cases)
        cases_ = std::make_unique<CaseKeeper>([this] { announce(); }, [this] { tell_content(); });
    if (options_.takes_own_faces)
        faces_ = std::make_unique<FaceKeeper>();
    if (session_.begin().size() + 1 > wire::max_first_envelope_size)
        throw Error(say(Phrase::long_join, std::to_string(wire::max_first_envelope_size)));
    start();
}

// Without memory even for another attempt.
void Participant::give_up() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->client = nullptr;
        shared_->status.phase = Phase::lost;
    }
    announce();
}

// From the decoding threads.
Decoders::Events Participant::decoded_events() {
    Decoders::Events events;
    events.frame = [this](receive::CameraFramePtr frame, std::uint64_t generation) {
        if (frame->depth.size.area() == 0 && !options_.takes_color_alone)
            return;
        {
            const std::lock_guard lock(shared_->mutex);
            if (generation != shared_->decoder_generation)
                return;
            shared_->newest[frame->camera].swap(frame);
        }
        // Outside of the lock, so that the network's thread does not wait for it.
        frame.reset();
        announce();
    };
    events.needs_key = [this](StreamId stream, SettingId setting) {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->client)
            shared_->client->post([this, stream, setting] { request_key(stream, setting); });
    };
    events.taken = [this](std::uint64_t connection, std::size_t bytes) {
        on_taken(connection, bytes);
    };
    events.problem = [this](const std::string& text) {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->client)
            shared_->client->post([this, text] { remark(text); });
    };
    events.now = [this] { return now(); };
    return events;
}

// From a decoding thread; the participant's thread sends the acknowledgement.
void Participant::on_taken(std::uint64_t connection, std::size_t bytes) {
    if ((connection & relayed_link) != 0)
        return relay_reception_->taken(connection & ~relayed_link, bytes);
    const std::lock_guard lock(shared_->mutex);
    if (connection != shared_->connection || !shared_->client)
        return;
    shared_->taken += bytes;
    if (!std::exchange(shared_->is_telling, true))
        shared_->client->post([this] { tell_taken(); });
}

void Participant::tell_taken() {
    std::size_t bytes = 0;
    {
        const std::lock_guard lock(shared_->mutex);
        bytes = std::exchange(shared_->taken, 0);
        shared_->is_telling = false;
    }
    shared_->client->taken(bytes);
}

bool Participant::begin_connection(net::Client& client) {
    {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->stopping)
            return false;
        shared_->client = &client;
        ++shared_->connection;
        shared_->taken = 0;
        shared_->is_telling = false;
        shared_->is_telling_room = false;
        shared_->is_asking_content = false;
        shared_->poses.clear();
        shared_->own_pose.reset();
        shared_->expressions.clear();
        shared_->own_expression.reset();
        shared_->voice.clear();
        shared_->visitors.clear();
        shared_->study.reset();
        shared_->study_replies.clear();
        shared_->chat.on_connected();
        // A hand that was up is raised again.
        if (shared_->own_hand_is_up())
            shared_->hand_wish = true;
        shared_->hand_told.reset();
        shared_->hand_shown = false;
        shared_->muted_since.reset();
        shared_->has_standing = false;
        shared_->status.standing = {};
        shared_->camera_wishes.clear();  // numbers of cameras may be others
        shared_->clock.forget();
        shared_->status.round_trip = {};
        shared_->status.clock_known = false;
    }
    if (cases_)
        cases_->on_connected();
    if (faces_)
        faces_->on_connected();
    return true;
}

// Returns the time until another attempt; nothing if there is to be none.
std::optional<Duration> Participant::end_connection(const net::Client::End& end) {
    std::unique_lock lock(shared_->mutex);
    shared_->client = nullptr;
    shared_->patient = shared_->asked_patient = {};
    shared_->media_waiting = 0;
    if (shared_->stopping)
        return std::nullopt;
    if (shared_->status.phase == Phase::joined || shared_->status.phase == Phase::waiting)
        attempts_.came_in();
    const Attempts::Judged judged =
        attempts_.after({session_.refusal(), session_.goodbye(), end.why, end.final});
    const bool again = judged.next == Attempts::Next::again;
    const bool ended = judged.next == Attempts::Next::ended;
    const bool news =
        shared_->status.problem != judged.why || shared_->status.phase == Phase::joined;
    shared_->status.phase = again ? Phase::lost : ended ? Phase::ended : Phase::refused;
    shared_->status.problem = judged.why;
    shared_->status.is_outdated = judged.is_outdated;
    // No camera's picture stays on a screen until a host is back that may never come.
    if (session_.goodbye().code == wire::TextCode::host_may_return && !options_.media) {
        shared_->decoder_generation = no_generation;  // what is being decoded comes too late
        shared_->cameras.clear();
        shared_->newest.clear();
        ++shared_->generation;
    }
    shared_->has_chat = shared_->has_chat && again;
    lock.unlock();
    if (!again)
        give_up_chat();
    end_relays();
    for (const Offer offer : all_offers)
        forget_numbers(offer);
    announce();
    if (ended)
        remark(judged.why);
    if (again && news)
        remark(say(attempts_.was_in() ? Phrase::reconnecting : Phrase::trying_again, judged.why));
    return again ? std::optional(judged.wait) : std::nullopt;
}

net::Client::Handler Participant::handler() {
    net::Client::Handler h;
    h.connected = [this] {
        pings_ = 0;
        numbers_ = {};
        offered_.clear();
        next_ping_ = next_report_ = steady_now();
        const Bytes hello = session_.begin();
        shared_->client->send_control(hello);
    };
    h.control = [this](ByteView message) { on_control(message); };
    h.media = [this](Bytes& message) { return on_media(message); };
    h.state = [this](const wire::State& state) { on_state(state); };
    h.voice = [this](const wire::Voice& voice) {
        if (options_.voice)
            options_.voice(voice.speaker, voice.packet);
    };
    // Not the session's clock: it jumps when it becomes known, and acknowledgements would wait for
    // as long as it jumped back.
    h.now = steady_now;
    h.tick = [this] { on_tick(); };
    return h;
}

bool Participant::on_media(Bytes& message) {
    if (has_come_by_relay(message))
        return true;
    const auto header = wire::parse_media_header(message);
    if (header)
        note_moment(*header);
    if (!options_.media)
        // Only this thread changes the number.
        return decoders_->on_media(message, shared_->connection);
    if (header)
        options_.media(*header, message);
    return true;
}

void Participant::on_state(const wire::State& state) {
    if (state.key.topic == wire::StateTopic::object) {
        {
            const std::lock_guard lock(shared_->mutex);
            shared_->room.on_pose(session::ObjectId(state.key.id), state.body);
        }
        if (options_.room_changed)
            options_.room_changed();
        return;
    }
    if (state.key.topic == wire::StateTopic::expression)
        return on_expression(ParticipantId{state.key.id}, state.body);
    if (state.key.topic == wire::StateTopic::own_face)
        return on_own_face(ParticipantId{state.key.id}, state.body);
    // A later host may send states that this participant does not know.
    const auto pose = state.key.topic == wire::StateTopic::pose
                          ? wire::decode_person_pose(state.body)
                          : theatron::Status::unsupported;
    const ParticipantId person{state.key.id};
    if (!pose || !session_.joined())
        return;
    {
        const std::lock_guard lock(shared_->mutex);
        if (!pose->head && !pose->left_hand && !pose->right_hand)
            shared_->poses.erase(person);
        else if (shared_->poses.size() < max_poses || shared_->poses.contains(person))
            shared_->poses[person] = *pose;
    }
    if (options_.pose)
        options_.pose(person, *pose);
}

void Participant::request_key(StreamId stream, SettingId setting) {
    shared_->client->send_control(wire::encode(wire::RequestKey{stream, setting}));
}

void Participant::on_control(ByteView message) {
    using Change = session::ViewerSession::Change;
    switch (session_.on_control(message)) {
        case Change::welcomed:
            on_welcome();
            tell_voice_consent();
            break;
        case Change::cameras:
            on_cameras();
            break;
        case Change::settings:
            if (!session_.note().empty())
                remark(wire::sentence(session_.note()));
            {
                const std::lock_guard lock(shared_->mutex);
                shared_->settings = session_.settings();
            }
            if (options_.described)
                options_.described();
            decoders_->set_settings(session_.settings());
            break;
        case Change::camera:
            on_camera_states();
            break;
        case Change::pong: {
            const wire::Pong& pong = session_.pong();
            bool is_new = false;
            {
                const std::lock_guard lock(shared_->mutex);
                shared_->clock.add(pong.ping_sent, pong.received, pong.sent, steady_now());
                Status& status = shared_->status;
                status.round_trip = shared_->clock.round_trip();
                status.newest_round_trip =
                    (steady_now() - pong.ping_sent) - (pong.sent - pong.received);
                ++status.pongs;
                status.clock_error = shared_->clock.error_bound();
                is_new = shared_->clock.known() && !std::exchange(status.clock_known, true);
                if (is_new)
                    shared_->figures = without_ages(std::move(shared_->figures));
            }
            if (is_new) {
                decoders_->forget_ages();
                offer_all();
            }
            if (is_new && session_.joined() && options_.described)
                options_.described();
            break;
        }
        case Change::delivery: {
            const std::lock_guard lock(shared_->mutex);
            shared_->status.delivery = session_.delivery();
            break;
        }
        case Change::renderer: {
            wire::SetRenderer command = session_.renderer_command();
            {
                const std::lock_guard lock(shared_->mutex);
                // A command that frees the choice keeps the renderer of the command before it.
                if (command.renderer.empty() && shared_->renderer_command)
                    command.renderer = shared_->renderer_command->renderer;
                shared_->renderer_command = std::move(command);
            }
            announce();
            break;
        }
        case Change::published:
            on_published();
            break;
        case Change::unshared:
            on_share_ended();
            break;
        case Change::encode:
            on_encode();
            break;
        case Change::encode_key:
            on_encode_key(session_.encode_key().stream, session_.encode_key().setting);
            break;
        case Change::room:
            on_room_message();
            break;
        case Change::waiting:
            on_waiting();
            break;
        case Change::standing:
            on_standing();
            break;
        case Change::visitors:
            on_visitors();
            break;
        case Change::managed:
            on_managed();
            break;
        case Change::playback:
            on_playback();
            break;
        case Change::patient:
        case Change::asked_patient:
            on_patient();
            break;
        case Change::study:
            on_study();
            break;
        case Change::study_reply:
            on_study_reply();
            break;
        case Change::chat:
            on_chat();
            break;
        case Change::relay_grants:
            on_relay_grants();
            break;
        case Change::cases:
            if (cases_)
                cases_->on_offer(session_.offered_cases());
            request_content();
            break;
        case Change::content:
            if (cases_)
                cases_->on_content(session_.content(), steady_now());
            if (faces_ && faces_->on_content(session_.content(), steady_now()))
                announce();
            break;
        case Change::refused:
            // A host closes the connection, too. The sentence is made of the refusal.
            shared_->client->end("");
            break;
        case Change::relay_receivers:
        case Change::goodbye:
        case Change::nothing:
            break;
    }
}

bool Participant::waits() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->status.phase == Phase::waiting;
}

void Participant::ping(TimePoint local) {
    shared_->client->send_control(wire::encode(wire::Ping{local}));
    // The offset is wanted soon; then it only has to follow the drift.
    next_ping_ = local + (++pings_ < 8 ? 100ms : 1000ms);
}

void Participant::on_tick() {
    const TimePoint local = steady_now();
    net::Client& client = *shared_->client;
    if (local >= next_ping_ && (session_.joined() || waits()))
        ping(local);
    if (!session_.joined())
        return;

    std::string depth_wish, color_wish;
    std::optional<wire::ChooseDelivery> delivery_wish;
    std::map<CameraId, wire::ChooseCodecs> camera_wishes;
    bool reset_wanted;
    {
        const std::lock_guard lock(shared_->mutex);
        reset_wanted = std::exchange(shared_->reset_wanted, false);
        depth_wish = std::exchange(shared_->depth_wish, "");
        color_wish = std::exchange(shared_->color_wish, "");
        delivery_wish = std::exchange(shared_->delivery_wish, std::nullopt);
        camera_wishes = std::exchange(shared_->camera_wishes, {});
    }
    if (reset_wanted) {
        decoders_->reset_figures();
        moments_.reset();
        next_report_ = local;
    }
    if (!depth_wish.empty() || !color_wish.empty())
        client.send_control(session_.choose(depth_wish, color_wish));

    for (const auto& [camera, wish] : camera_wishes)
        client.send_control(
            session::ViewerSession::choose(camera, wish.depth_codec, wish.color_codec));

    on_encode_keys();
    request_content();
    send_own_face();
    tell_chat();
    if (delivery_wish)
        client.send_control(session_.choose_delivery(*delivery_wish));

    if (local < next_report_)
        return;
    next_report_ = local + 100ms;
    auto figures = decoders_->figures();
    {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->status.clock_known)
            figures = without_ages(std::move(figures));
    }
    wire::Report report;
    for (const auto& f : figures)
        report.streams.push_back({f.stream, f.newest, std::uint32_t(f.frames), f.bytes,
                                  Duration(std::int64_t(f.age_ms * 1000)),
                                  relayed_setting(f.stream, local)});
    note_relayed_streams(local);
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->figures = figures;
        shared_->moments = moments_.figures();
        report.renderer = shared_->renderer;
    }
    client.send_control(wire::encode(report));
}

void Participant::announce() const {
    shared_->changed.notify_all();
    if (options_.news)
        options_.news();
}

void Participant::remark(const std::string& text) const {
    // The text may contain text of the host.
    if (options_.remark)
        options_.remark(clean_text(text, max_remark_characters));
}

}  // namespace theatron::client
