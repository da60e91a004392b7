// SPDX-License-Identifier: Apache-2.0
// The voices of a recording: see intake.h.
#include <algorithm>

#include "record/intake.h"
#include "record/recording_layout.h"
#include "record/speaker_note.h"

namespace theatron::record {
namespace {

bool names(const std::vector<RecordedVoice>& voices, ParticipantId person) {
    return std::any_of(voices.begin(), voices.end(),
                       [&](const RecordedVoice& voice) { return voice.person == person; });
}

}  // namespace

void Intake::describe_voices(std::vector<RecordedVoice> voices) {
    const std::lock_guard lock(mutex_);
    agreed_ = std::move(voices);
    if (agreed_.size() > max_voice_tracks)
        agreed_.resize(max_voice_tracks);
    for (VoiceLane& lane : voices_)
        if (lane.person && is_free(lane))
            lane.sequence.interrupt();
    if (!recorder_ || !problem_.empty())
        return;
    const bool lacked = lacks_voice_lanes();
    for (const RecordedVoice& voice : agreed_)
        (void)voice_lane_of(voice.person);
    if (!lacked)
        return;
    for (auto& [id, entry] : entries_)
        entry.gate.want_key();
}

bool Intake::is_free(const VoiceLane& lane) const {
    return !lane.person || !names(agreed_, *lane.person);
}

// More people agree than the segment has tracks.
bool Intake::lacks_voice_lanes() const {
    return recorder_ && agreed_.size() > voices_.size() && voices_.size() < max_voice_tracks &&
           options_.has_room;
}

void Intake::interrupt_voices() {
    const std::lock_guard lock(mutex_);
    for (const RecordedVoice& voice : agreed_) {
        const bool speaks = std::ranges::any_of(voices_, [&](const VoiceLane& lane) {
            const VoiceSequence::Figures& figures = lane.sequence.figures();
            return lane.person == voice.person && figures.packets + figures.left_out > 0;
        });
        if (!speaks && !spoken_.contains(voice.person))
            continue;
        spoken_[voice.person].who = voice;
        ++spoken_[voice.person].interruptions;
    }
}

void Intake::interrupt_voice(ParticipantId person) {
    const std::lock_guard lock(mutex_);
    for (VoiceLane& lane : voices_)
        if (lane.person == person)
            lane.sequence.interrupt();
}

std::vector<VoiceTrack> Intake::voice_tracks() const {
    std::vector<VoiceTrack> tracks;
    if (!options_.has_room)
        return tracks;  // no session, nobody speaks
    const std::size_t count =
        std::min(std::max(agreed_.size() + spare_voices, voices_.size()), max_voice_tracks);
    for (std::size_t i = 0; i < count; ++i)
        tracks.push_back({track_number(voice_stream(i)),
                          i < agreed_.size() ? agreed_[i].name : "voice " + std::to_string(i + 1)});
    return tracks;
}

// Those of the person who has the lane until now.
void Intake::keep_figures(const VoiceLane& lane) {
    const VoiceSequence::Figures& figures = lane.sequence.figures();
    if (!lane.person || figures.packets + figures.left_out == 0)
        return;
    Voice& voice = spoken_[*lane.person];
    voice.who = {*lane.person, name_in(lane.note)};
    voice.figures.packets += figures.packets;
    voice.figures.missing += figures.missing;
    voice.figures.left_out += figures.left_out;
}

void Intake::begin_voices(TimePoint begin) {
    for (const VoiceLane& lane : voices_)
        keep_figures(lane);
    const std::size_t tracks = voice_tracks().size();
    voices_.clear();
    filled_until_ = begin;
    for (std::size_t i = 0; i < tracks; ++i) {
        voices_.push_back({std::nullopt, "", VoiceSequence(begin)});
        if (i < agreed_.size()) {
            voices_[i].person = agreed_[i].person;
            voices_[i].note = speaker_note(agreed_[i]);
        }
    }
}

// The lane of a person who agreed; null if there are more such people than lanes. A new person gets
// the lane of somebody of the same name who has left, else one that nobody had, else a free one.
Intake::VoiceLane* Intake::voice_lane_of(ParticipantId person) {
    for (VoiceLane& lane : voices_)
        if (lane.person == person)
            return &lane;
    const auto who = std::find_if(agreed_.begin(), agreed_.end(),
                                  [&](const RecordedVoice& v) { return v.person == person; });
    if (who == agreed_.end())
        return nullptr;
    const auto of_name = [&](const VoiceLane& lane) {
        return lane.person && is_free(lane) && name_in(lane.note) == who->name;
    };
    const auto of_nobody = [](const VoiceLane& lane) { return !lane.person; };
    auto found = std::find_if(voices_.begin(), voices_.end(), of_name);
    if (found == voices_.end())
        found = std::find_if(voices_.begin(), voices_.end(), of_nobody);
    if (found == voices_.end())
        found = std::find_if(voices_.begin(), voices_.end(),
                             [&](const VoiceLane& lane) { return is_free(lane); });
    if (found == voices_.end())
        return nullptr;
    keep_figures(*found);
    found->sequence.begin_speaker();
    found->person = person;
    found->note = speaker_note(*who);
    return &*found;
}

void Intake::take_voice(ParticipantId person, const VoicePacket& packet, TimePoint now) {
    const std::lock_guard lock(mutex_);
    // Until the segment of a new connection begins, times are of another clock.
    const bool is_between = pending_ && pending_->new_connection;
    if (!problem_.empty() || !names(agreed_, person))
        return;
    if (keeps() && !kept_.empty())
        kept_.push_back(
            [this, person, packet, now, opus = Bytes(packet.opus.begin(), packet.opus.end())] {
                VoicePacket own = packet;
                own.opus = opus;
                put_voice(person, own, now);
            });
    else if (recorder_ && !is_between)
        put_voice(person, packet, now);
}

void Intake::put_voice(ParticipantId person, const VoicePacket& packet, TimePoint now) {
    VoiceLane* const lane = voice_lane_of(person);
    if (!lane)
        return;
    const auto index = std::size_t(lane - voices_.data());
    lane->sequence.put(packet,
                       [&](const VoiceSequence::Block& block) { add_voice(index, block, now); });
}

void Intake::pass_time(const Now& now) {
    const std::lock_guard lock(mutex_);
    end_change_in_time(now);
    // A room in which nothing changes sends no further part.
    if (problem_.empty() && !kept_.empty() && room_begins_segment(now.local) &&
        !begin(*std::exchange(pending_, std::nullopt), kept_from_, now))
        return;
    const bool is_between = pending_ && pending_->new_connection;
    const bool pictures_come = std::any_of(entries_.begin(), entries_.end(), [&](const auto& e) {
        return !e.second.ended && now.local - e.second.heard <= quiet_patience;
    });
    if (!problem_.empty() || !recorder_ || is_between || pictures_come)
        return;
    fill_voices(now.clock.session - (quiet_patience - voice_patience), now.clock.session);
}

// Everything up to voice_patience before `until` has come or will not come.
void Intake::fill_voices(TimePoint until, TimePoint now) {
    if (until <= filled_until_)
        return;
    filled_until_ = until;
    for (std::size_t i = 0; i < voices_.size(); ++i)
        voices_[i].sequence.fill(until - voice_patience, [&](const VoiceSequence::Block& block) {
            add_voice(i, block, now);
        });
}

void Intake::add_voice(std::size_t index, const VoiceSequence::Block& block, TimePoint now) {
    VoiceLane& lane = voices_[index];
    wire::MediaHeader header;
    header.codec = block.is_silence ? silence_codec : voice_codec;
    header.key = true;
    header.stream = voice_stream(index);
    header.setting = SettingId(-block.level_db);
    header.frame = header.reference = lane.blocks++;
    header.payload_size = std::uint32_t(block.opus.size());
    header.moment = header.captured = lane.sequence.begin() + block.at;
    auto message = std::make_shared<Bytes>(wire::media_header_size);
    wire::write_media_header(header, message->data());
    message->insert(message->end(), block.opus.begin(), block.opus.end());
    if (recorder_->add(header, std::move(message), now, lane.note) == Recorder::Added::dropped &&
        !block.is_silence && lane.person)
        ++spoken_[*lane.person].dropped;
}

std::vector<Intake::Voice> Intake::voices() const {
    const std::lock_guard lock(mutex_);
    std::map<ParticipantId, Voice> all = spoken_;
    for (const VoiceLane& lane : voices_) {
        if (!lane.person)
            continue;
        const VoiceSequence::Figures& figures = lane.sequence.figures();
        Voice& voice = all[*lane.person];
        voice.who = {*lane.person, name_in(lane.note)};
        voice.figures.packets += figures.packets;
        voice.figures.missing += figures.missing;
        voice.figures.left_out += figures.left_out;
    }
    std::vector<Voice> result;
    for (auto& [person, voice] : all)
        result.push_back(std::move(voice));
    return result;
}

}  // namespace theatron::record
