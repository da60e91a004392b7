// SPDX-License-Identifier: Apache-2.0
#include "capture/recorded_voices.h"

#include <algorithm>

#include "record/recording_layout.h"
#include "record/speaker_note.h"
#include "voice/opus_codec.h"

namespace theatron::capture {

RecordedVoices::RecordedVoices(std::shared_ptr<const record::RecordingFile> recording)
    : recording_(std::move(recording)), places_(recording_->voices().size()) {}

void RecordedVoices::restart_at(Duration begin) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const record::StreamContent& content = recording_->voices()[i].content;
        Place& place = places_[i] = {};
        while (place.next < content.frames.size() && content.frames[place.next].time() < begin)
            ++place.next;
    }
}

void RecordedVoices::play(Duration end, const std::function<void(const RecordedSpeech&)>& speech) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const record::VoiceContent& voice = recording_->voices()[i];
        const record::StreamContent& content = voice.content;
        Place& place = places_[i];
        for (; place.next < content.frames.size() && content.frames[place.next].time() < end;
             ++place.next) {
            for (; place.change < content.filters.size() &&
                   content.filters[place.change].frame <= place.next;
                 ++place.change) {
                const auto who = record::parse_speaker_note(content.filters[place.change].filters);
                place.person = who ? who->person : ParticipantId{};
            }
            RecordedSpeech one;
            one.person = place.person;
            if (read(voice, place.next, one))
                speech(one);
        }
    }
}

// False for silence, and for what is damaged.
bool RecordedVoices::read(const record::VoiceContent& voice, std::size_t index,
                          RecordedSpeech& speech) {
    const record::RecordedFrame& frame = voice.content.frames[index];
    const auto header = recording_->read_header(frame);
    if (header && header->codec == record::silence_codec)
        return false;
    ++figures_.packets;
    const std::size_t samples = header && recording_->read_payload(frame, payload_) == Status::ok
                                    ? voice::samples_in(payload_)
                                    : 0;
    if (samples == 0) {
        ++figures_.damaged;
        return false;
    }
    speech.at = frame.time();
    speech.samples = samples;
    speech.level_db = -std::min(int(header->setting), 127);
    speech.opus = payload_;
    speech.pauses = true;
    if (index + 1 < voice.content.frames.size()) {
        const auto next = recording_->read_header(voice.content.frames[index + 1]);
        speech.pauses = !next || next->codec == record::silence_codec;
    }
    return true;
}

}  // namespace theatron::capture
