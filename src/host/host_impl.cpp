// SPDX-License-Identifier: Apache-2.0
// The part of a host that runs on the server's thread.
#include "host/host_impl.h"

#include <algorithm>

#include "base/clock_wait.h"
#include "base/fault.h"
#include "base/hex_text.h"
#include "base/log.h"
#include "net/congestion_control.h"

namespace theatron::host {
namespace {

// Time for participants to receive the Goodbye.
constexpr Duration goodbye_patience = std::chrono::seconds(1);

net::PeerId peer_of(ParticipantId participant) {
    return net::PeerId(std::uint32_t(participant));
}

}  // namespace

net::Server::Handler Host::Impl::handler() {
    net::Server::Handler h;
    h.connected = [this](net::PeerId peer, const std::string& address, bool) {
        addresses[peer] = address;
        session->on_connected(ParticipantId(std::uint32_t(peer)), steady_now(), address);
        carry_out();
    };
    h.control = [this](net::PeerId peer, ByteView bytes) {
        heard[peer] = steady_now();
        session->on_control(ParticipantId(std::uint32_t(peer)), bytes, steady_now());
        carry_out();
        set_alarm();
    };
    h.state = [this](net::PeerId peer, const wire::State& state) { take_state(peer, state); };
    h.voice = [this](net::PeerId peer, const wire::Voice& voice) { forward_voice(peer, voice); };
    h.alarm = [this] { on_alarm(); };
    h.frame_left = [this](net::PeerId) { release_lanes(); };
    h.control_lost = [this](net::PeerId peer) {
        session->resynchronise(ParticipantId(std::uint32_t(peer)));
        carry_out();
    };
    h.media = [this](net::PeerId peer, Bytes& message) {
        forward(peer, std::make_shared<Bytes>(std::move(message)));
        message = {};
        return true;
    };
    h.closed = [this](net::PeerId peer, const std::string& why) {
        const std::string address = addresses[peer];
        if (const auto left_out = joins.take("left " + address, steady_now()))
            log::info("host", "participant left",
                      {{"id", int(peer)}, log::outside("why", why), {"left_out", *left_out}});
        session->on_closed(ParticipantId(std::uint32_t(peer)));
        poses.remove(ParticipantId(std::uint32_t(peer)), steady_now());
        voices.remove(ParticipantId(std::uint32_t(peer)));
        set_alarm();
        carry_out();
        addresses.erase(peer);
        heard.erase(peer);
        note_left(peer);
    };
    h.tick = [this] {
        measure_links();
        hold_lanes();
        tell_problems();
        session->on_tick(steady_now());
        follow_playback("");
        carry_out();
        color_watch.on_tick(lanes.all(), steady_now());
        note_participants();
        follow_recording();
        room_file->on_tick(session->room(), session->streams().cameras().adjustments(),
                           steady_now());
    };
    return h;
}

PortSession Host::Impl::in_port() {
    PortSession given;
    given.name_in_log = in_logs;
    given.events = handler();
    given.knows_again = [this](const wire::Join& hello) {
        return session->knows_again(hello, steady_now());
    };
    given.find_token = [this](const std::string& secret) { return find_token(secret); };
    given.must_ask = [this](wire::Role role) { return must_ask(role); };
    given.is_held_back = [this](const std::string& secret) { return is_held_back(secret); };
    given.http_tokens = [this] { return http_tokens(); };
    given.metrics_token = metrics_token;
    given.figures = [this] { return figures(); };
    given.picture = [this](std::size_t camera) {
        return camera < thumbnails.size() ? thumbnails[camera].png() : std::string();
    };
    given.links = [this] { return links->links(); };
    given.make_link = [this](wire::Role role, std::optional<files::UtcSeconds> expires,
                             const std::string& label, const std::string& by) {
        KnownLink made = links->make(role, expires, label, by);
        server->post([this] { take_links(); });
        return made;
    };
    given.revoke_link = [this](const std::string& link, const std::string& by) {
        server->post([this, link, by] {
            session->revoke_link(link, by);
            carry_out();
        });
    };
    given.manage = [this](wire::ManageAction action, ParticipantId person, const std::string& by) {
        server->post([this, action, person, by] { decide({0, action, person, {}}, by); });
    };
    given.audit = [this](const session::AuditEvent& event) {
        if (audit)
            audit->add(event, "");
    };
    given.recording = [this]() -> RecordingProgram& { return *recording; };
    return given;
}

// A fault in one action costs only the participant that the action is for.
void Host::Impl::carry_out() {
    for (const session::Action& next : session->take_actions())
        std::visit(
            [&](const auto& a) {
                const bool done = contain("host", [&] { carry_out(a); });
                if constexpr (requires { a.participant; })
                    if (!done)
                        server->close(peer_of(a.participant), "it met a fault here");
            },
            next);
}

void Host::Impl::carry_out(const session::action::Send& a) {
    server->send_control(peer_of(a.participant), wire::encode(a.message));
}

void Host::Impl::carry_out(const session::action::Close& a) {
    const net::PeerId peer = peer_of(a.participant);
    if (const auto left_out = joins.take("refused " + addresses[peer], steady_now()))
        log::warning("host", "participant refused",
                     {{"id", int(peer)},
                      {"address", addresses[peer]},
                      log::outside("why", a.why),
                      {"left_out", *left_out}});
    server->close(peer, a.why);
}

void Host::Impl::carry_out(const session::action::Drop& a) {
    server->drop(peer_of(a.participant), a.why);
}

void Host::Impl::carry_out(const session::action::End& a) {
    const net::PeerId peer = peer_of(a.participant);
    leaving.insert(peer);
    server->send_control(peer, wire::encode(a.message));
    server->close(peer, "the session has ended");
}

void Host::Impl::carry_out(const session::action::Joined& a) {
    // After Welcome.
    server->post([this, id = a.participant] {
        const auto found = session->participants().find(id);
        if (found != session->participants().end() && found->second.may(session::Right::see))
            send_poses_to(id, poses.all());
    });
    const std::string& address = addresses[peer_of(a.participant)];
    if (const auto left_out = joins.take(address + " " + a.name, steady_now()))
        log::info("host", "participant joined",
                  {{"id", int(a.participant)},
                   {"address", address},
                   log::outside("name", a.name),
                   {"person", hex_text(session::shown_person(a.person))},
                   {"left_out", *left_out}});
}

void Host::Impl::carry_out(const session::action::RequestKey& a) {
    if (send::CameraLane* lane = lanes.find(std::size_t(camera_of(a.key.stream))))
        lane->request_key(a.key.stream, a.key.setting);
}

void Host::Impl::carry_out(const session::action::ChangeSettings& a) {
    const auto convert = [](const std::vector<session::ActiveSetting>& settings) {
        std::vector<send::LaneSetting> result;
        for (const auto& s : settings)
            result.push_back({s.id, s.codec});
        return result;
    };
    const auto camera = std::size_t(a.camera);
    send::CameraLane* lane = lanes.find(camera);
    if (!lane)
        return;
    lane->set_settings(convert(session->depth_settings(a.camera)),
                       convert(session->color_settings(a.camera)));
    hold_lane(camera);
}

void Host::Impl::carry_out(const session::action::TakeMedia& a) {
    server->take_media(peer_of(a.participant), a.max_message);
}

void Host::Impl::carry_out(const session::action::KeepEverything& a) {
    // At once: until the next tick a late thread could drop pictures that are already recorded.
    media.keep_everything(true);
    server->keep_everything(peer_of(a.participant));
}

void Host::Impl::carry_out(const session::action::SetCeiling& a) {
    server->set_ceiling(peer_of(a.participant), double(a.bytes_per_second));
}

void Host::Impl::carry_out(const session::action::Delay& a) {
    server->set_delay(peer_of(a.participant), a.by);
}

void Host::Impl::carry_out(const session::action::ChangeRights& a) {
    const auto found = session->participants().find(a.participant);
    if (found == session->participants().end())
        return;
    poses.follow_rights(
        a.participant, [&](session::Right right) { return found->second.may(right); },
        steady_now());
    set_alarm();
}

void Host::Impl::carry_out(const session::action::Stepped& a) {
    if (changes.take(std::to_string(int(a.participant)), steady_now()))
        log::info("host", "sending changed", {{"id", int(a.participant)}, {"to", a.to}});
}

void Host::Impl::carry_out(const session::action::Drawing& a) {
    log::info("host", "participant draws",
              {{"id", int(a.participant)}, log::outside("renderer", a.renderer)});
}

// A range that goes beyond the content is cut at its end.
void Host::Impl::carry_out(const session::action::SendContent& a) {
    auto bytes = session->own_face(a.content);
    if (!bytes && cases)
        bytes = cases->content(a.content);
    const bool is_here = bytes && a.offset < bytes->size();
    const std::uint64_t end =
        is_here ? a.offset + std::min<std::uint64_t>(a.count, bytes->size() - a.offset) : 0;
    server->send_content(peer_of(a.participant),
                         {a.content, is_here ? bytes : nullptr, a.offset, end});
}

void Host::Impl::carry_out(const session::action::SendState& a) {
    const wire::State state{a.key, a.body};
    server->send_states(peer_of(a.participant), {&state, 1});
}

void Host::Impl::note_left(net::PeerId peer) {
    if (leaving.erase(peer) > 0 && leaving.empty()) {
        const std::lock_guard lock(goodbye_mutex);
        all_left = true;
        goodbye_changed.notify_all();
    }
}

void Host::Impl::keep_for_next_time() {
    if (const auto link = ended_recording())
        links->revoke(*link, steady_now());
    room_file->save(session->room(), session->streams().cameras().adjustments(), steady_now());
    if (audit && !has_ended)
        audit->add(session::event_of_session(session::AuditEvent::What::ended,
                                             ends_by_host ? session::at_the_host : "", name),
                   "");
}

void Host::Impl::say_goodbye() {
    server->post([this] {
        has_ended = session->has_ended();
        // A placeholder, so that `leaving` is not empty until all goodbyes are queued.
        constexpr net::PeerId nobody{};
        leaving.insert(nobody);
        session->end(farewell);
        carry_out();
        note_left(nobody);
    });
    std::unique_lock lock(goodbye_mutex);
    wait_for(goodbye_changed, lock, goodbye_patience, [this] { return all_left; });
}

// While every receiver of a camera still waits for its last frame, the next is not even
// begun: dropped after encoding, it would be missing as a reference.
void Host::Impl::hold_lane(std::size_t camera) {
    send::CameraLane* const lane = lanes.find(camera);
    if (!lane)
        return;
    const bool hold = session->all_wait(CameraId(camera), [&](ParticipantId id) {
        const net::PeerId peer{std::uint32_t(id)};
        return server->is_behind(peer, depth_stream(CameraId(camera))) ||
               server->is_behind(peer, color_stream(CameraId(camera)));
    });
    if (hold == held.contains(camera))
        return;
    if (hold)
        held.insert(camera);
    else
        held.erase(camera);
    lane->hold(hold);
}

void Host::Impl::hold_lanes() {
    for (std::size_t camera = 0; camera < lanes.size(); ++camera)
        hold_lane(camera);
}

// A frame that leaves can only end a wait.
void Host::Impl::release_lanes() {
    for (const std::size_t camera : std::vector(held.begin(), held.end()))
        hold_lane(camera);
}

void Host::Impl::take_media(send::EncodedMedia encoded) {
    if (media.put(std::move(encoded)))
        server->post([this] { distribute_media(); });
}

void Host::Impl::take_camera_state(wire::CameraState state) {
    bool first;
    {
        const std::lock_guard lock(states_mutex);
        lane_states[state.camera] = state;
        first = pass_on(std::move(state));
    }
    if (first)
        server->post([this] { on_camera_states(); });
}

void Host::Impl::take_place(CameraId camera, const wire::Text& problem) {
    bool first;
    {
        const std::lock_guard lock(states_mutex);
        misplaced[camera] = problem;
        wire::CameraState state = lane_states[camera];
        state.camera = camera;
        first = pass_on(std::move(state));
    }
    if (first)
        server->post([this] { on_camera_states(); });
}

// The states' mutex is held. A camera's own problem comes before that of its place. True if
// on_camera_states() must be called.
bool Host::Impl::pass_on(wire::CameraState state) {
    if (state.problem.empty())
        state.problem = misplaced[state.camera];
    const bool first = new_states.empty();
    new_states[state.camera] = std::move(state);
    return first;
}

void Host::Impl::on_camera_states() {
    std::map<CameraId, wire::CameraState> states;
    {
        const std::lock_guard lock(states_mutex);
        states.swap(new_states);
    }
    for (const auto& [camera, state] : states) {
        const auto [told, is_first] = told_states.try_emplace(camera);
        const bool was_live = !is_first && told->second.condition == wire::CameraCondition::live;
        told->second.condition = state.condition;
        using Condition = wire::CameraCondition;
        if (state.condition == Condition::failed)
            log::error("host", "camera failed",
                       {{"camera", int(camera)}, {"problem", wire::english(state.problem)}});
        else if (state.condition == Condition::stale)
            log::warning("host", "camera is stale",
                         {{"camera", int(camera)}, {"problem", wire::english(state.problem)}});
        else if (state.condition == Condition::live) {
            if (!was_live)
                log::info("host", "camera is live", {{"camera", int(camera)}});
            // The problem that it had before its pictures stood still is not told again.
            const wire::Text problem = std::exchange(told->second.problem, state.problem);
            if (problem.code != state.problem.code && !state.problem.empty())
                log::warning("host", "camera has a problem",
                             {{"camera", int(camera)}, {"problem", wire::english(state.problem)}});
            else if (problem.code != state.problem.code)
                log::info(
                    "host", "camera has no problem any more",
                    {{"camera", int(camera)}, {"problem", wire::english_without_advice(problem)}});
        } else if (!state.problem.empty()) {
            log::warning("host", "camera has a problem",
                         {{"camera", int(camera)}, {"problem", wire::english(state.problem)}});
        }
        session->on_camera(state);
    }
    carry_out();
}

void Host::Impl::distribute_media() {
    const auto taken = media.take();
    for (const auto& [stream, setting] : taken.broken)
        session->on_broken_stream(stream, setting);
    for (const auto& [stream, dropped] : taken.dropped)
        dropped_slow[camera_of(stream)] += dropped;
    for (const send::EncodedMedia& encoded : taken.media)
        distribute(encoded);
    set_alarm();
}

net::Media media_of(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message) {
    return {std::move(message), header.stream,         header.setting, header.frame,
            header.reference,   header.temporal_layer, header.key,     {}};
}

void Host::Impl::distribute(const send::EncodedMedia& encoded) {
    const wire::MediaHeader& header = encoded.header;
    const auto to = session->on_media(header, encoded.message->size(), steady_now());
    send_media(media_of(header, encoded.message), to.receivers);
    send_sealed(header, *encoded.message, to);
    session->keep(header, *encoded.message, steady_now());
    hold_lane(std::size_t(camera_of(header.stream)));
}

void Host::Impl::take_state(net::PeerId peer, const wire::State& state) {
    const ParticipantId sender{std::uint32_t(peer)};
    const auto found = session->participants().find(sender);
    if (found == session->participants().end() || !found->second.may(session::Right::see))
        return;
    if (state.key.topic == wire::StateTopic::object)
        return forward_object_pose(peer, state);
    if (session::OwnFaces::is_topic(state.key.topic)) {
        if (!session->on_own_face(sender, state, steady_now()))
            end_flood(peer, "there were far more pieces of a face than a host takes");
        return carry_out();
    }
    const auto may = [&](session::Right right) { return session->allow(sender, right); };
    if (poses.put(sender, state, may, steady_now()) == session::PoseBoard::Answer::flood)
        end_flood(peer, "there were far more poses or expressions than a host sends on");
    set_alarm();
}

void Host::Impl::end_flood(net::PeerId peer, const std::string& why) {
    log::warning("host", "participant is cut off", {{"id", int(peer)}, {"why", why}});
    session->end_flood(ParticipantId(std::uint32_t(peer)), steady_now());
    carry_out();
}

// A grab does not wait for the tick of people's poses.
void Host::Impl::forward_object_pose(net::PeerId peer, const wire::State& state) {
    const auto forward =
        session->on_object_pose(ParticipantId(std::uint32_t(peer)), state, steady_now());
    if (forward.is_flood)
        end_flood(peer, "there were far more poses of objects than a host sends on");
    for (const ParticipantId receiver : forward.receivers)
        server->send_states(peer_of(receiver), {&state, 1});
}

void Host::Impl::replay_room(const RoomReplay::Change& change) {
    const TimePoint now = steady_now();
    const std::vector<session::ObjectPose> moved = session->replay_room(change.objects, now);
    carry_out();
    for (const session::ObjectPose& pose : moved) {
        const Bytes body = session::encode_object_pose(pose);
        const wire::State state{{wire::StateTopic::object, std::uint32_t(pose.object)}, body};
        for (const ParticipantId receiver : session->room().receivers())
            server->send_states(peer_of(receiver), {&state, 1});
    }
    const auto replayed = [](ParticipantId person) {
        return std::uint32_t(person) | session::recorded_bit;
    };
    for (const ParticipantId person : change.left)
        poses.remove(ParticipantId(replayed(person)), now);
    for (const auto& [person, body] : change.poses)
        (void)poses.put(
            ParticipantId(replayed(person)), {{wire::StateTopic::pose, replayed(person)}, body},
            [](session::Right) { return true; }, now);
    set_alarm();
}

void Host::Impl::replay_voices(const std::vector<RoomReplay::Speech>& speech) {
    for (const ParticipantId receiver : session::VoiceFloor::listeners_of_replay(*session))
        for (const RoomReplay::Speech& said : speech)
            server->send_voice(
                peer_of(receiver),
                {ParticipantId(std::uint32_t(said.person) | session::recorded_bit), said.packet});
}

void Host::Impl::send_poses() {
    const auto entries = poses.gather(steady_now());
    std::vector<ParticipantId> receivers;
    for (const auto& [id, participant] : session->participants())
        if (participant.may(session::Right::see))
            receivers.push_back(id);
    for (const ParticipantId receiver : receivers)
        send_poses_to(receiver, entries);
}

// Everybody predicts their own.
void Host::Impl::send_poses_to(ParticipantId receiver,
                               const std::vector<session::PoseBoard::Entry>& entries) {
    std::vector<wire::State> states;
    for (const auto& entry : entries)
        if (entry.participant != receiver)
            states.push_back(entry.state);
    if (!states.empty())
        server->send_states(net::PeerId(std::uint32_t(receiver)), states);
}

void Host::Impl::forward(net::PeerId publisher, std::shared_ptr<const Bytes> message) {
    const auto to =
        session->on_media_from(ParticipantId(std::uint32_t(publisher)), *message, steady_now());
    if (const auto header = wire::parse_media_header(*message)) {
        note_received(ParticipantId(std::uint32_t(publisher)), *header, message->size());
        send_sealed(*header, *message, to);
        send_media(media_of(*header, std::move(message)), to.receivers);
    }
    carry_out();
    set_alarm();
}

void Host::Impl::note_received(ParticipantId publisher, const wire::MediaHeader& header,
                               std::size_t size) {
    const CameraId id = camera_of(header.stream);
    Received& of = received[id];
    of.bytes += size;
    const session::CameraStreams* camera = session->streams().cameras().find(id);
    if (!camera || camera->publisher() != publisher)
        return;
    if (!of.is_compared) {
        const auto calibration = decode_calibration(camera->description().calibration);
        of.is_compared = camera->description().kind == wire::CameraKind::room && calibration &&
                         !is_screen(*calibration);
    }
    if (!*of.is_compared)
        return;
    of.sync_offset = header.captured - header.moment;
    moments->note(publisher, id, header.moment, header.captured);
}

void Host::Impl::send_media(const net::Media& encoded,
                            const std::vector<ParticipantId>& receivers) {
    for (const ParticipantId receiver : receivers) {
        const auto pushed = server->send_media(peer_of(receiver), encoded);
        dropped_slow[camera_of(encoded.stream)] += std::uint64_t(pushed.dropped);
        if (pushed.needs_key)
            session->on_broken_stream(encoded.stream, encoded.setting);
    }
}

// Once for all relays. Each setting of a stream is a chain of its own for an outbox, since a relay
// is sent several of them.
void Host::Impl::send_sealed(const wire::MediaHeader& header, ByteView message,
                             const session::HostSession::Recipients& to) {
    if (to.relays.empty())
        return;
    const auto& key = session->relay_key(steady_now());
    if (!sealer || sealer->key_number() != key.number)
        sealer.emplace(key.number, key.bytes);
    wire::MediaHeader told = header;
    told.temporal_layer = std::uint8_t(to.layer);
    net::Media sealed = media_of(
        told, std::make_shared<const Bytes>(sealer->seal(told, wire::media_payload(message))));
    sealed.stream = StreamId(std::uint16_t(header.setting));
    for (const ParticipantId relay : to.relays) {
        const auto pushed = server->send_media(peer_of(relay), sealed);
        dropped_slow[camera_of(header.stream)] += std::uint64_t(pushed.dropped);
        if (pushed.needs_key)
            session->on_broken_stream(header.stream, header.setting);
    }
}

void Host::Impl::measure_links() {
    for (const auto& [id, participant] : session->participants()) {
        const auto f = server->take_figures(net::PeerId(std::uint32_t(id)));
        session->on_link(id,
                         {f.bytes_per_second, f.round_trip, f.delay, f.dropped, f.takes_nothing,
                          f.loses_packets},
                         steady_now());
    }
}

HostFigures Host::Impl::figures() const {
    const std::lock_guard lock(figures_mutex);
    HostFigures figures;
    figures.name = name;
    figures.session_time = steady_now();
    figures.utc = utc_now();
    figures.seconds = to_seconds(figures.session_time - begun);
    figures.automatic_color = color_watch.reason();
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        const auto dropped = dropped_slow_figures.find(CameraId(i));
        const send::CameraLane* lane = lanes.find(i);
        figures.cameras.push_back({lane ? lane->figures() : figures_of_missing(i),
                                   dropped == dropped_slow_figures.end() ? 0 : dropped->second});
    }
    figures.participants = participant_figures;
    figures.published = published_figures;
    if (moments)
        figures.moments = moments->figures();
    for (const auto& [camera, adjustment] : adjusted_figures)
        figures.adjusted[camera] = text_of(adjustment);
    if (place_watch)
        figures.places = place_watch->figures();
    figures.registration = {places.made, places.method, registration_problem};
    if (gain_watch)
        figures.gains = gain_watch->gains();
    figures.visitors = visitor_figures;
    figures.case_problems = case_problem_figures;
    figures.certificates = port->certificates();
    figures.has_ended = ended_figure;
    figures.past_bytes = past_figure;
    figures.turned_away = port->turned_away();
    static const bool offers_bbr = net::kernel_offers_bbr();
    figures.offers_bbr = offers_bbr;
    figures.faults = fault_count();
    figures.page_problem = port->page_problem();
    figures.problems = problems();
    return figures;
}

}  // namespace theatron::host
