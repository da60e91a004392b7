// SPDX-License-Identifier: Apache-2.0
// The names that make a Matroska file a recording (docs/formats/recording.md).
#pragma once

#include <string>

#include "base/ids.h"

namespace theatron::record {

inline constexpr const char* depth_codec_id = "V_THEATRON/DEPTH";
inline constexpr const char* color_codec_id = "V_THEATRON/COLOR";  // all but JPEG
inline constexpr const char* jpeg_codec_id = "V_MJPEG";
inline constexpr const char* room_codec_id = "D_THEATRON/ROOM";
inline constexpr const char* calibration_mime_type = "application/x-theatron-calibration";
inline constexpr const char* segment_info_name = "segment.bin";
inline constexpr const char* segment_info_mime_type = "application/x-theatron-segment";
inline constexpr const char* side_name = "theatron.media-header";
inline constexpr const char* note_name = "theatron.filters";
inline constexpr const char* check_name = "theatron.check";
// A tag of a recovered file: the losses in the original.
inline constexpr const char* recovered_tag = "THEATRON_RECOVERED";
// A tag of a file whose writing failed: the cause, one of the three below.
inline constexpr const char* early_end_tag = "THEATRON_ENDED";
inline constexpr const char* next_segment_tag = "THEATRON_NEXT";
// A tag of a recording's last file: letters for what the recorder knew to be missing (lacks.h).
inline constexpr const char* lacks_tag = "THEATRON_LACKS";
inline constexpr const char* disk_full = "disk full";
inline constexpr const char* disk_failed = "disk failed";
inline constexpr const char* file_too_large = "file size";  // the system allows no larger one
inline constexpr const char* no_filters = "off";
inline constexpr const char* unnamed_filters = "unnamed";

inline constexpr const char* voice_codec_id = "A_OPUS";
inline constexpr const char* speaker_note_name = "theatron.speaker";

inline constexpr int max_camera_track = 126;
// Voices are streams of their own, in tracks 128 to 255.
inline constexpr StreamId first_voice_stream{127};
inline constexpr std::size_t max_voice_tracks = 128;
// In the media headers of voices: a packet of the speaker, and silence of the recorder.
inline constexpr std::uint8_t voice_codec = 1, silence_codec = 2;
// The state of the room is one more stream, in track 256.
inline constexpr StreamId room_stream{255};
// In its media headers: the version of the parts (docs/formats/room.md).
inline constexpr std::uint8_t room_codec = 1;

inline constexpr const char* room_track_name = "room";

constexpr StreamId voice_stream(std::size_t voice) {
    return StreamId(std::size_t(first_voice_stream) + voice);
}
constexpr bool is_voice(StreamId stream) {
    return stream >= first_voice_stream && stream < voice_stream(max_voice_tracks);
}
constexpr int track_number(StreamId stream) {
    return int(stream) + 1;
}
constexpr StreamId stream_of_track(int number) {
    return StreamId(number - 1);
}

inline std::string calibration_name(CameraId camera) {
    return "calibration-" + std::to_string(int(camera)) + ".bin";
}

}  // namespace theatron::record
