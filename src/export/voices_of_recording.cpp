// SPDX-License-Identifier: Apache-2.0
#include "export/voices_of_recording.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include "base/error.h"
#include "capture/recorded_voices.h"
#include "export/export_places.h"
#include "record/speaker_note.h"
#include "sound/wav_bytes.h"
#include "voice/opus_codec.h"

namespace theatron::exporting {
namespace {

// RFC 7845, 4.2: samples by which an encoder's output is later than its input.
constexpr std::int64_t opus_delay = 312;
// The head of a WAV file has sizes of 32 bits.
constexpr Duration longest_wav = std::chrono::hours(12);
// Length of all tracks whose packets are taken at once, which keeps a person's in order.
constexpr Duration at_once = std::chrono::milliseconds(500);

std::map<ParticipantId, std::string> names_in(const record::RecordingFile& recording) {
    std::map<ParticipantId, std::string> names;
    for (const record::VoiceContent& voice : recording.voices())
        for (const record::FilterChange& change : voice.content.filters)
            if (const auto who = record::parse_speaker_note(change.filters))
                names[who->person] = who->name;
    return names;
}

// Decodes a person's packets; `samples` gets them with the place of the first, counted from the
// recording's first picture.
class Person {
public:
    using Samples = std::function<void(std::int64_t place, std::span<const float> samples)>;

    bool take(const capture::RecordedSpeech& speech, const Samples& samples) {
        decoded_.resize(speech.samples);
        if (!decoder_.decode(speech.opus, decoded_))
            return false;
        if (samples)
            samples(speech.at.count() * voice::sample_rate / 1'000'000 - opus_delay, decoded_);
        return true;
    }

private:
    voice::Decoder decoder_;
    std::vector<float> decoded_;
};

// Everything that was said, in order for each person.
VoicesSummary decode_all(const std::shared_ptr<const record::RecordingFile>& recording,
                         const std::function<Person::Samples(ParticipantId)>& samples_of) {
    VoicesSummary summary;
    const std::map<ParticipantId, std::string> names = names_in(*recording);
    Duration last{};
    for (const record::VoiceContent& voice : recording->voices()) {
        summary.blocks += voice.content.frames.size();
        summary.damaged += voice.content.damaged;
        for (const record::RecordedFrame& frame : voice.content.frames) {
            summary.bytes += frame.payload_size;
            last = std::max(last, frame.time());
        }
    }
    std::map<ParticipantId, Person> people;
    std::map<ParticipantId, RecordedPerson> found;
    capture::RecordedVoices voices(recording);
    const auto take = [&](const capture::RecordedSpeech& speech) {
        if (!people[speech.person].take(speech, samples_of(speech.person))) {
            ++summary.damaged;
            return;
        }
        RecordedPerson& person = found[speech.person];
        ++person.packets;
        person.seconds += double(speech.samples) / voice::sample_rate;
    };
    for (Duration end = at_once; end < last + 2 * at_once; end += at_once)
        voices.play(end, take);
    summary.damaged += voices.figures().damaged;
    for (auto& [id, person] : found) {
        person.id = id;
        if (const auto name = names.find(id); name != names.end())
            person.name = name->second;
        summary.people.push_back(std::move(person));
    }
    return summary;
}

class WavFile {
public:
    explicit WavFile(const std::filesystem::path& path)
        : path_(path), file_(path, std::ios::binary | std::ios::trunc) {
        put(sound::wav_head(0));
    }
    void add(std::int64_t place, std::span<const float> samples) {
        const auto skipped =
            std::size_t(std::clamp<std::int64_t>(end_ - place, 0, std::int64_t(samples.size())));
        Bytes bytes;
        ByteWriter out(bytes);
        for (; end_ < place; ++end_) {
            out.put(std::int16_t(0));
            if (bytes.size() >= (1 << 20)) {
                put(bytes);
                bytes.clear();
            }
        }
        for (const float v : samples.subspan(skipped))
            out.put(std::int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767)));
        end_ += std::int64_t(samples.size() - skipped);
        if (Duration(end_ * 1000 / 48) > longest_wav)
            throw Error("A WAV file holds 12 hours; '" + path_.string() +
                        "' would be longer. Export the segments one by one.");
        put(bytes);
    }
    void finish() {
        file_.seekp(0);
        put(sound::wav_head(std::uint32_t(2 * end_)));
        file_.close();
        require();
    }

private:
    void put(ByteView bytes) {
        file_.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        require();
    }
    void require() const {
        if (!file_)
            throw Error("'" + path_.string() + "' cannot be written; check its disk.");
    }

    std::filesystem::path path_;
    std::ofstream file_;
    std::int64_t end_ = 0;
};

}  // namespace

VoicesSummary summarize_voices(const std::shared_ptr<const record::RecordingFile>& recording) {
    return decode_all(recording, [](ParticipantId) { return Person::Samples(); });
}

std::vector<std::filesystem::path> export_voices(
    const std::shared_ptr<const record::RecordingFile>& recording,
    const std::filesystem::path& folder, bool overwrite, VoicesSummary& summary) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    const auto path_of = [&](ParticipantId id) {
        return folder / ("voice-" + std::to_string(std::uint32_t(id)) + ".wav");
    };
    for (const auto& [id, name] : names_in(*recording))
        require_free(path_of(id), overwrite);
    std::map<ParticipantId, WavFile> files;
    summary = decode_all(recording, [&](ParticipantId id) {
        WavFile& file = files.try_emplace(id, path_of(id)).first->second;
        return [&file](std::int64_t place, std::span<const float> samples) {
            file.add(place, samples);
        };
    });
    std::vector<std::filesystem::path> written;
    for (auto& [id, file] : files) {
        file.finish();
        written.push_back(path_of(id));
    }
    return written;
}

}  // namespace theatron::exporting
