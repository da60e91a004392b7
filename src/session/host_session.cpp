// SPDX-License-Identifier: Apache-2.0
#include "session/host_session.h"

#include <algorithm>
#include <utility>

namespace theatron::session {
namespace {

constexpr Duration renderer_interval = std::chrono::seconds(1);
constexpr Duration longest_made_in = std::chrono::milliseconds(100);

RequestBudget::Kind kind_of(const wire::ToHost& message) {
    using Kind = RequestBudget::Kind;
    if (std::holds_alternative<wire::ChooseCodecs>(message))
        return Kind::codecs;
    if (std::holds_alternative<wire::ChooseDelivery>(message))
        return Kind::delivery;
    if (std::holds_alternative<wire::RequestKey>(message))
        return Kind::key;
    if (std::holds_alternative<wire::Ping>(message))
        return Kind::ping;
    if (std::holds_alternative<wire::Report>(message))
        return Kind::report;
    return Kind::other;
}

std::string shown_name(const std::string& name) {
    return name.find_first_not_of(' ') == std::string::npos ? "guest" : name;
}

}  // namespace

HostSession::HostSession(Config config)
    : config_(std::move(config)),
      depth_(numbers_, config_.usual_depth),
      color_(numbers_, config_.usual_color) {}

void HostSession::on_connected(ParticipantId id, TimePoint now) {
    const auto found = participants_.try_emplace(id, 2 * config_.cameras.size()).first;
    found->second.connected = now;
}

void HostSession::on_control(ParticipantId id, ByteView bytes, TimePoint now) {
    const auto found = participants_.find(id);
    if (found == participants_.end() || found->second.closing)
        return;
    Participant& participant = found->second;

    auto message = wire::decode_to_host(bytes);
    // A newer participant may say things that this host need not understand.
    if (!message && message.error() != Status::unsupported)
        return refuse(id, "A message was " + std::string(to_text(message.error())) + ".");
    if (message && !participant.joined) {
        const auto* hello = std::get_if<wire::Join>(&*message);
        return hello ? join(id, *hello) : refuse(id, "Join first.");
    }
    switch (participant.budget.ask(message ? kind_of(*message) : RequestBudget::Kind::other, now)) {
        case RequestBudget::Answer::granted:
            if (message)
                carry_out(id, *message, now);
            break;
        case RequestBudget::Answer::too_often:
            if (message)
                keep_for_later(participant, std::move(*message));
            break;
        case RequestBudget::Answer::flood:
            refuse(id, "There were far more requests than a host answers.");
            break;
    }
}

// A request of a participant who has joined.
void HostSession::carry_out(ParticipantId id, const wire::ToHost& message, TimePoint now) {
    const Participant& participant = participants_.at(id);
    if (const auto* wish = std::get_if<wire::ChooseCodecs>(&message)) {
        choose(id, wish->depth_codec, wish->color_codec);
    } else if (const auto* lost = std::get_if<wire::RequestKey>(&message)) {
        const bool own = lost->setting == (is_depth(lost->stream) ? participant.depth_setting
                                                                  : participant.color_setting);
        if (own && std::size_t(camera_of(lost->stream)) < config_.cameras.size())
            key_requests_.request({lost->stream, lost->setting});
    } else if (const auto* ping = std::get_if<wire::Ping>(&message)) {
        send(id, wire::Pong{ping->sent, now, now});
    } else if (const auto* report = std::get_if<wire::Report>(&message)) {
        note_report(id, *report, now);
    } else if (const auto* goal = std::get_if<wire::ChooseDelivery>(&message)) {
        set_goal(id, *goal);
    }
}

// Of wishes the last counts; all else is asked for or said again.
void HostSession::keep_for_later(Participant& participant, wire::ToHost message) {
    if (auto* wish = std::get_if<wire::ChooseCodecs>(&message)) {
        wire::ChooseCodecs& late =
            participant.late_codecs ? *participant.late_codecs : participant.late_codecs.emplace();
        if (!wish->depth_codec.empty())
            late.depth_codec = std::move(wish->depth_codec);
        if (!wish->color_codec.empty())
            late.color_codec = std::move(wish->color_codec);
    } else if (const auto* goal = std::get_if<wire::ChooseDelivery>(&message)) {
        participant.late_goal = *goal;
    }
}

void HostSession::carry_out_late(ParticipantId id, Participant& participant, TimePoint now) {
    using Kind = RequestBudget::Kind;
    RequestBudget& budget = participant.budget;
    if (participant.late_codecs && budget.grant_later(Kind::codecs, now)) {
        const auto wish = *std::exchange(participant.late_codecs, std::nullopt);
        choose(id, wish.depth_codec, wish.color_codec);
    }
    if (participant.late_goal && budget.grant_later(Kind::delivery, now))
        set_goal(id, *std::exchange(participant.late_goal, std::nullopt));
}

void HostSession::end() {
    for (auto& [id, participant] : participants_) {
        if (!participant.takes_part())
            continue;
        participant.closing = true;
        actions_.push_back(action::End{id, {"The host has ended the session."}});
    }
}

void HostSession::join(ParticipantId id, const wire::Join& hello) {
    if (hello.protocol_min > wire::protocol_max)
        return refuse(id, "This host is older than your Theatron (protocol " +
                              std::to_string(wire::protocol_max) + ", you need " +
                              std::to_string(hello.protocol_min) + "); update the host.");
    if (hello.protocol_max < wire::protocol_min)
        return refuse(id, "Your Theatron is too old for this host (protocol " +
                              std::to_string(hello.protocol_max) + ", it needs " +
                              std::to_string(wire::protocol_min) + "); update it.");
    if (!config_.equal_secrets(hello.token, config_.token))
        return refuse(id, "The join token is wrong; ask for the host's current link.");

    std::string depth, color;
    for (const std::string& problem : {check(config_.check_depth, hello.depth_codec, depth),
                                       check(config_.check_color, hello.color_codec, color)})
        if (!problem.empty())
            return refuse(id, problem);
    if (hello.records && std::count_if(participants_.begin(), participants_.end(), [](auto& entry) {
                             return entry.second.takes_part() && entry.second.records;
                         }) >= max_recorders)
        return refuse(id,
                      "This session is recorded " + std::to_string(max_recorders) +
                          " times already, which is as often as can be; end another recording.");

    Participant& participant = participants_.at(id);
    participant.joined = true;
    participant.records = hello.records;
    participant.name = shown_name(hello.name);
    actions_.push_back(action::Joined{id, participant.name});
    participant.protocol = std::min(hello.protocol_max, wire::protocol_max);
    describe_session(id);
    if (hello.records)
        actions_.push_back(action::KeepEverything{id});
    wish(id, depth, color);
    set_goal(id, {hello.target_latency_ms, hello.max_kbit_per_s});
    tell_renderer(id);
    apply_settings();
}

void HostSession::describe_session(ParticipantId id) {
    send(id, wire::Welcome{participants_.at(id).protocol, id, config_.name, config_.cameras});
    for (const auto& [camera, state] : camera_states_)
        send(id, state);
}

void HostSession::resynchronise(ParticipantId id) {
    const auto found = participants_.find(id);
    if (found == participants_.end() || !found->second.takes_part())
        return;
    describe_session(id);
    found->second.depth_setting = found->second.color_setting = {};
    send(id, found->second.delivery.message({}));
    tell_renderer(id);
    apply_settings();
}

void HostSession::note_report(ParticipantId id, const wire::Report& report, TimePoint now) {
    Participant& participant = participants_.at(id);
    participant.report = report.streams;
    std::string renderer = report.renderer;
    // Reports repeat it; who changes it all the time must not fill the log.
    if (renderer == participant.renderer || now - participant.renderer_noted < renderer_interval)
        return;
    participant.renderer_noted = now;
    participant.renderer = renderer;
    actions_.push_back(action::Drawing{id, std::move(renderer)});
}

// Says what holds for this one, if anything was ever said.
void HostSession::tell_renderer(ParticipantId id) {
    const Participant& participant = participants_.at(id);
    const auto named = renderer_words_.find(participant.name);
    if (participant.renderer_word)
        send(id, *participant.renderer_word);
    else if (named != renderer_words_.end())
        send(id, named->second);
    else if (renderer_word_)
        send(id, *renderer_word_);
}

void HostSession::set_renderer(const wire::SetRenderer& word) {
    renderer_word_ = word;
    renderer_words_.clear();
    for (auto& [id, participant] : participants_) {
        participant.renderer_word.reset();
        if (participant.takes_part())
            tell_renderer(id);
    }
}

void HostSession::set_renderer(ParticipantId id, const wire::SetRenderer& word) {
    const auto found = participants_.find(id);
    if (found == participants_.end() || !found->second.takes_part())
        return;
    found->second.renderer_word = word;
    tell_renderer(id);
}

void HostSession::set_renderer(const std::string& name, const wire::SetRenderer& word) {
    renderer_words_[name] = word;
    for (auto& [id, participant] : participants_)
        if (participant.name == name && participant.takes_part()) {
            participant.renderer_word.reset();
            tell_renderer(id);
        }
}

void HostSession::set_goal(ParticipantId id, const wire::ChooseDelivery& goal) {
    participants_.at(id).delivery.set_goal(goal);
    actions_.push_back(action::SetCeiling{id, goal.max_kbit_per_s * 125ull});
}

void HostSession::choose(ParticipantId id, const std::string& depth, const std::string& color) {
    std::string depth_codec, color_codec, note;
    if (!depth.empty())
        note = check(config_.check_depth, depth, depth_codec);
    if (!color.empty() && note.empty())
        note = check(config_.check_color, color, color_codec);
    if (!note.empty()) {
        // The old codecs stay.
        wire::Settings unchanged;
        unchanged.note = note;
        return send(id, unchanged);
    }
    wish(id, depth_codec, color_codec);
    take_step(id);
}

// Notes what the participant asks for; an empty text keeps its codec.
void HostSession::wish(ParticipantId id, const std::string& depth, const std::string& color) {
    Participant& participant = participants_.at(id);
    if (!depth.empty()) {
        participant.asked_depth = depth;
        depth_.wish(id, depth);
    }
    if (!color.empty()) {
        participant.asked_color = color;
        color_.wish(id, color);
    }
    if (participant.records) {
        depth_.pin(id);
        color_.pin(id);
    }
    set_wish(id);
}

// Makes the ladder of what the participant wishes.
void HostSession::set_wish(ParticipantId id) {
    participants_.at(id).delivery.set_wish(depth_.wished(id), color_.wished(id), config_.steps,
                                           region_is_drawn_);
}

void HostSession::on_region(bool is_drawn) {
    if (std::exchange(region_is_drawn_, is_drawn) == is_drawn)
        return;
    for (auto& [id, participant] : participants_) {
        // A region adds steps down, which a recorder does not take.
        if (!participant.takes_part() || participant.records)
            continue;
        set_wish(id);
        send(id, participant.delivery.message({}));
        take_step(id);
    }
}

// Asks for the encodings of the participant's step.
void HostSession::take_step(ParticipantId id) {
    const LadderStep& step = participants_.at(id).delivery.step();
    depth_.stopgap(id, step.depth_codec);
    color_.stopgap(id, step.color_codec);
    apply_settings();
}

std::string HostSession::check(const CheckCodec& check, const std::string& text,
                               std::string& codec) const {
    CheckedCodec checked = check(text);
    codec = std::move(checked.codec);
    return std::move(checked.problem);
}

void HostSession::refuse(ParticipantId id, std::string reason) {
    send(id, wire::Refused{reason});
    participants_.at(id).closing = true;
    actions_.push_back(action::Close{id, std::move(reason)});
}

// Brings encoders and participants in line with the tables.
void HostSession::apply_settings() {
    const auto changed = [&](std::vector<ActiveSetting>& announced, const SettingTable& table) {
        if (announced == table.active())
            return false;
        for (const ActiveSetting& old : announced)
            if (std::find(table.active().begin(), table.active().end(), old) ==
                table.active().end()) {
                key_requests_.forget(old.id);
                rates_.forget(old.id);
                made_in_.erase(old.id);
                std::erase_if(slow_, [&](const auto& entry) { return entry.second == old.id; });
                std::erase_if(newest_depth_,
                              [&](const auto& entry) { return entry.first.second == old.id; });
            }
        announced = table.active();
        return true;
    };
    const bool depth_changed = changed(announced_depth_, depth_);
    const bool color_changed = changed(announced_color_, color_);
    if (depth_changed || color_changed)
        actions_.push_back(action::ChangeSettings{});

    for (auto& [id, participant] : participants_) {
        if (!participant.joined)
            continue;
        const ActiveSetting& depth = depth_.given(id);
        const ActiveSetting& color = color_.given(id);
        if (depth.id == participant.depth_setting && color.id == participant.color_setting)
            continue;
        wire::Settings settings;
        for (const wire::Camera& camera : config_.cameras) {
            settings.settings.push_back({camera.depth_stream, depth.id, depth.codec});
            if (camera.has_color)
                settings.settings.push_back({camera.color_stream, color.id, color.codec});
            if (depth.id != participant.depth_setting)
                key_requests_.request({camera.depth_stream, depth.id});
            if (camera.has_color && color.id != participant.color_setting)
                key_requests_.request({camera.color_stream, color.id});
        }
        const LadderStep& step = participant.delivery.step();
        const bool records = participant.records;
        const std::string& asked_depth = records ? participant.asked_depth : step.depth_codec;
        const std::string& asked_color = records ? participant.asked_color : step.color_codec;
        const bool other_depth = depth.codec != asked_depth;
        if (other_depth || color.codec != asked_color)
            settings.note = "The host already encodes in " +
                            std::to_string(SettingTable::max_active) + " ways; instead of " +
                            (other_depth ? asked_depth : asked_color) +
                            " you get the nearest of them.";
        participant.depth_setting = depth.id;
        participant.color_setting = color.id;
        send(id, std::move(settings));
    }
}

void HostSession::on_closed(ParticipantId participant) {
    participants_.erase(participant);
    depth_.leave(participant);
    color_.leave(participant);
    apply_settings();
}

void HostSession::on_camera(const wire::CameraState& state) {
    camera_states_[state.camera] = state;
    for (const auto& [id, participant] : participants_)
        if (participant.joined)
            send(id, state);
}

void HostSession::on_encoding(CameraId camera, SettingId setting, bool keeps_up,
                              double ms_per_picture) {
    const auto is_slow = [&] {
        return std::any_of(slow_.begin(), slow_.end(),
                           [&](const auto& entry) { return entry.second == setting; });
    };
    const auto active = [&](const SettingTable& table) {
        const auto found = std::find_if(table.active().begin(), table.active().end(),
                                        [&](const ActiveSetting& s) { return s.id == setting; });
        return found == table.active().end() ? nullptr : &*found;
    };
    const ActiveSetting* depth = active(depth_);
    const ActiveSetting* color = active(color_);
    if (!depth && !color)
        return;  // it has been left meanwhile
    const bool was_slow = is_slow();
    if (keeps_up)
        slow_.erase({camera, setting});
    else
        slow_.insert({camera, setting});
    if (is_slow() == was_slow)
        return;
    if (!was_slow) {
        const std::string note =
            "Encoding " + (depth ? depth : color)->codec + " takes " +
            std::to_string(int(ms_per_picture + 0.5)) +
            " ms a picture here, more than its share, so you get fewer pictures than the cameras "
            "take; another codec would be faster.";
        for (const auto& [id, participant] : participants_)
            if (participant.takes_part() &&
                (participant.depth_setting == setting || participant.color_setting == setting))
                send(id, wire::Settings{{}, note});
    }
    (depth ? depth_ : color_).set_slow(setting, !was_slow);
    apply_settings();
}

void HostSession::on_broken_stream(StreamId stream, SettingId setting) {
    key_requests_.request({stream, setting});
}

double HostSession::frames_per_second() const {
    double fastest = 1;
    for (const wire::Camera& camera : config_.cameras)
        fastest = std::max(fastest, camera.frames_per_second);
    return fastest;
}

// Of depth and colour the longer. Settings are measured apart: one that is encoded slowly makes
// nobody else's frames late.
Duration HostSession::made_in(const Participant& participant) const {
    Duration longest{};
    for (const SettingId setting : {participant.depth_setting, participant.color_setting})
        if (const auto found = made_in_.find(setting); found != made_in_.end())
            longest = std::max(longest, found->second);
    return longest;
}

void HostSession::on_link(ParticipantId id, const LinkMeasure& link, TimePoint now) {
    const auto found = participants_.find(id);
    if (found == participants_.end() || !found->second.takes_part())
        return;
    Delivery& delivery = found->second.delivery;
    const Delivery::Given given{depth_.given(id), color_.given(id), frames_per_second()};
    if (!delivery.update(link, given, rates_, made_in(found->second), now))
        return;
    const wire::Delivery message = delivery.message(link.delay);
    actions_.push_back(action::Stepped{id, message.what + ": " + message.reason});
    send(id, message);
    take_step(id);
}

// Colour has the layer of the depth that belongs to it, so that the same moments
// are left out of both.
int HostSession::layer_for(const Participant& participant, const wire::MediaHeader& header) const {
    const auto depth = newest_depth_.find({camera_of(header.stream), participant.depth_setting});
    if (depth == newest_depth_.end() || depth->second.frame != header.frame)
        return layer_by_number(header.frame);
    return depth->second.layer;
}

// Whether no frame of this colour setting can be left out.
bool HostSession::is_chain(SettingId id) const {
    const auto& active = color_.active();
    const auto setting = std::find_if(active.begin(), active.end(),
                                      [&](const ActiveSetting& s) { return s.id == id; });
    return setting != active.end() && config_.steps.color_is_chain &&
           config_.steps.color_is_chain(setting->codec);
}

std::vector<ParticipantId> HostSession::on_media(const wire::MediaHeader& header, std::size_t size,
                                                 TimePoint now) {
    const auto& active = (is_depth(header.stream) ? depth_ : color_).active();
    const auto setting = std::find_if(active.begin(), active.end(),
                                      [&](const auto& s) { return s.id == header.setting; });
    if (setting == active.end())
        return {};
    // A frame that is sent again, or of a camera that lags, says nothing about encoding.
    const Duration age = std::clamp(now - header.captured, Duration(0), longest_made_in);
    Duration& made_in = made_in_[header.setting];
    made_in += (age - made_in) / 16;

    int layer = std::min(int(header.temporal_layer), served_layers - 1);
    if (is_depth(header.stream)) {
        if (config_.steps.layered && config_.steps.layered(setting->codec).independent)
            layer = layer_by_number(header.frame);
        newest_depth_[{camera_of(header.stream), header.setting}] = {header.frame, layer};
    }
    rates_.add(header.stream, header.setting, layer, size, now);

    std::vector<ParticipantId> result = receivers(header.stream, header.setting);
    if (!is_depth(header.stream) && is_chain(header.setting))
        return result;
    std::erase_if(result, [&](ParticipantId id) {
        Participant& participant = participants_.at(id);
        return !participant.records &&
               !participant.delivery.lets_through(header.stream, layer_for(participant, header));
    });
    return result;
}

void HostSession::on_tick(TimePoint now) {
    for (auto& [id, participant] : participants_) {
        if (!participant.joined && !participant.closing &&
            now - participant.connected > join_deadline)
            refuse(id, "No join came in time.");
        if (participant.takes_part())
            carry_out_late(id, participant, now);
    }
    for (const KeyRequests::Key& key : key_requests_.take(now))
        actions_.push_back(action::RequestKey{key});
}

std::vector<Action> HostSession::take_actions() {
    return std::exchange(actions_, {});
}

bool HostSession::all_wait(const std::function<bool(ParticipantId)>& is_behind) const {
    bool any = false;
    for (const auto& [id, participant] : participants_) {
        if (!participant.takes_part())
            continue;
        if (participant.delivery.adapts() || !is_behind(id))
            return false;
        any = true;
    }
    return any;
}

std::vector<ParticipantId> HostSession::receivers(StreamId stream, SettingId setting) const {
    std::vector<ParticipantId> result;
    for (const auto& [id, participant] : participants_)
        if (participant.takes_part() &&
            setting == (is_depth(stream) ? participant.depth_setting : participant.color_setting))
            result.push_back(id);
    return result;
}

void HostSession::send(ParticipantId id, wire::ToParticipant message) {
    actions_.push_back(action::Send{id, std::move(message)});
}

}  // namespace theatron::session
