// SPDX-License-Identifier: Apache-2.0
#include "record/matroska_elements.h"

#include <ebml/EbmlHead.h>
#include <ebml/EbmlSubHead.h>
#include <ebml/EbmlVoid.h>
#include <matroska/FileKax.h>
#include <matroska/KaxAttachments.h>
#include <matroska/KaxBlock.h>
#include <matroska/KaxBlockData.h>
#include <matroska/KaxCluster.h>
#include <matroska/KaxCues.h>
#include <matroska/KaxCuesData.h>
#include <matroska/KaxInfo.h>
#include <matroska/KaxInfoData.h>
#include <matroska/KaxSeekHead.h>
#include <matroska/KaxSegment.h>
#include <matroska/KaxSemantic.h>
#include <matroska/KaxTags.h>
#include <matroska/KaxTracks.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "record/crc32c.h"

namespace theatron::record {
namespace {

using namespace libebml;
using namespace libmatroska;

// TrackType of RFC 9559 that the library has no name for.
constexpr std::uint64_t metadata_track = 33;
constexpr std::int64_t ns_per_tick = 1000;  // block times count microseconds
// For Opus (RFC 7845, 4.2 and 4.6): the encoder's delay of 312 samples, and the time that a decoder
// takes to converge.
constexpr std::uint64_t opus_delay_ns = 6'500'000, opus_pre_roll_ns = 80'000'000;
constexpr double opus_rate_hz = 48'000;

std::uint64_t type_of(TrackKind kind) {
    switch (kind) {
        case TrackKind::video:
            return track_video;
        case TrackKind::opus:
            return track_audio;
        case TrackKind::metadata:
            break;
    }
    return metadata_track;
}

// Appends the bytes that libebml renders to a byte sequence.
class BytesOut final : public IOCallback {
public:
    explicit BytesOut(Bytes& out) : out_(out) {}
    uint32 read(void*, size_t) override { return 0; }
    void setFilePointer(int64, seek_mode) override { assert(!"elements are written in order"); }
    size_t write(const void* bytes, size_t size) override {
        const auto* begin = static_cast<const std::byte*>(bytes);
        out_.insert(out_.end(), begin, begin + size);
        return size;
    }
    uint64 getFilePointer() override { return out_.size(); }
    void close() override {}

private:
    Bytes& out_;
};

void render(EbmlElement& element, Bytes& out) {
    BytesOut io(out);
    // Values that equal a default are written too: the file explains itself.
    element.Render(io, true);
}

// Elements hold default children from birth, which would be written as well.
void clear(EbmlMaster& element) {
    for (EbmlElement* child : element.GetElementList())
        delete child;
    element.RemoveAll();
}

template <class Element>
struct Empty : Element {
    Empty() { clear(*this); }
};

template <class Element>
Element& add(EbmlMaster& parent) {
    Element& element = AddNewChild<Element>(parent);
    if constexpr (std::is_base_of_v<EbmlMaster, Element>)
        clear(element);
    return element;
}

template <class Element>
void add_number(EbmlMaster& parent, std::uint64_t value) {
    *static_cast<EbmlUInteger*>(&add<Element>(parent)) = value;
}

template <class Element>
void add_text(EbmlMaster& parent, const std::string& value) {
    *static_cast<EbmlString*>(&add<Element>(parent)) = value;
}

template <class Element>
void add_unicode(EbmlMaster& parent, const std::string& value) {
    add<Element>(parent).SetValueUTF8(value);
}

template <class Element>
void add_bytes(EbmlMaster& parent, ByteView value) {
    // The library copies from the pointer also where there is nothing to copy.
    const std::byte nothing{};
    const std::byte* const bytes = value.empty() ? &nothing : value.data();
    add<Element>(parent).CopyBuffer(reinterpret_cast<const binary*>(bytes), uint32(value.size()));
}

}  // namespace

void render_ebml_head(Bytes& out) {
    Empty<EbmlHead> head;
    add_number<EVersion>(head, 1);
    add_number<EReadVersion>(head, 1);
    add_number<EMaxIdLength>(head, 4);
    add_number<EMaxSizeLength>(head, 8);
    add_text<EDocType>(head, "matroska");
    add_number<EDocTypeVersion>(head, 4);
    add_number<EDocTypeReadVersion>(head, 2);
    render(head, out);
}

void render_info(const MatroskaInfo& about, std::int64_t duration_us, Bytes& out) {
    Empty<KaxInfo> info;
    if (about.uid)
        add_bytes<KaxSegmentUID>(info, *about.uid);
    if (about.family_uid)
        add_bytes<KaxSegmentFamily>(info, *about.family_uid);
    add_number<KaxTimecodeScale>(info, ns_per_tick);
    auto& duration = add<KaxDuration>(info);
    duration.SetPrecision(EbmlFloat::FLOAT_64);  // of one size, whatever the value
    *static_cast<EbmlFloat*>(&duration) = double(duration_us);
    add<KaxDateUTC>(info).SetEpochDate(
        std::chrono::floor<std::chrono::seconds>(about.utc).time_since_epoch().count());
    add_unicode<KaxMuxingApp>(info, "libmatroska");
    add_unicode<KaxWritingApp>(info, "Theatron");
    render(info, out);
}

void render_tracks(const MatroskaLayout& layout, Bytes& out) {
    Empty<KaxTracks> tracks;
    for (const Track& track : layout.tracks) {
        auto& entry = add<KaxTrackEntry>(tracks);
        add_number<KaxTrackNumber>(entry, std::uint64_t(track.number));
        add_number<KaxTrackUID>(entry, std::uint64_t(track.number));
        add_number<KaxTrackType>(entry, type_of(track.kind));
        add_number<KaxTrackFlagDefault>(entry, track.shown);
        add_number<KaxTrackFlagLacing>(entry, 0);
        if (!track.name.empty())
            add_unicode<KaxTrackName>(entry, track.name);
        add_text<KaxCodecID>(entry, track.codec_id);
        if (!track.codec_private.empty())
            add_bytes<KaxCodecPrivate>(entry, track.codec_private);
        if (track.frames_per_second > 0)
            add_number<KaxTrackDefaultDuration>(
                entry, std::uint64_t(std::llround(1e9 / track.frames_per_second)));
        const auto add_mapping = [&](int id, const std::string& name) {
            auto& mapping = add<KaxBlockAdditionMapping>(entry);
            add_number<KaxBlockAddIDValue>(mapping, std::uint64_t(id));
            add_text<KaxBlockAddIDName>(mapping, name);
            add_number<KaxBlockAddIDType>(mapping, 0);
        };
        const std::string& note_name = track.note_name.empty() ? layout.note_name : track.note_name;
        const std::pair<int, const std::string*> additions[] = {
            {side_id, &layout.side_name}, {note_id, &note_name}, {check_id, &layout.check_name}};
        int max_id = 0;
        for (const auto& [id, name] : additions)
            max_id = name->empty() ? max_id : id;
        if (max_id > 0)
            add_number<KaxMaxBlockAdditionID>(entry, std::uint64_t(max_id));
        for (const auto& [id, name] : additions)
            if (!name->empty())
                add_mapping(id, *name);
        if (track.kind == TrackKind::opus) {
            add_number<KaxCodecDelay>(entry, opus_delay_ns);
            add_number<KaxSeekPreRoll>(entry, opus_pre_roll_ns);
            auto& audio = add<KaxTrackAudio>(entry);
            *static_cast<EbmlFloat*>(&add<KaxAudioSamplingFreq>(audio)) = opus_rate_hz;
            add_number<KaxAudioChannels>(audio, 1);
        }
        if (track.kind != TrackKind::video)
            continue;
        auto& video = add<KaxTrackVideo>(entry);
        add_number<KaxVideoPixelWidth>(video, std::uint64_t(track.width));
        add_number<KaxVideoPixelHeight>(video, std::uint64_t(track.height));
    }
    render(tracks, out);
}

void render_attachments(const std::vector<Attachment>& attachments, Bytes& out) {
    if (attachments.empty())
        return;
    Empty<KaxAttachments> list;
    std::uint64_t next_uid = 1;
    for (const Attachment& attachment : attachments) {
        auto& file = add<KaxAttached>(list);
        add_unicode<KaxFileName>(file, attachment.name);
        add_text<KaxMimeType>(file, attachment.mime_type);
        add_bytes<KaxFileData>(file, attachment.bytes);
        add_number<KaxFileUID>(file, attachment.uid != 0 ? attachment.uid : next_uid++);
    }
    render(list, out);
}

void render_tags(const std::vector<Tag>& tags, Bytes& out) {
    if (tags.empty())
        return;
    Empty<KaxTags> list;
    for (const Tag& tag : tags) {
        auto& entry = add<KaxTag>(list);
        auto& targets = add<KaxTagTargets>(entry);
        if (tag.track != 0) {
            add_text<KaxTagTargetType>(targets, "TRACK");
            add_number<KaxTagTrackUID>(targets, std::uint64_t(tag.track));
        }
        if (tag.attachment_uid != 0) {
            add_text<KaxTagTargetType>(targets, "ATTACHMENT");
            add_number<KaxTagAttachmentUID>(targets, tag.attachment_uid);
        }
        auto& simple = add<KaxTagSimple>(entry);
        add_unicode<KaxTagName>(simple, tag.name);
        add_unicode<KaxTagString>(simple, tag.value);
    }
    render(list, out);
}

void render_void(std::size_t size, Bytes& out) {
    assert(size >= void_head_size);
    const std::size_t begin = out.size();
    out.resize(begin + size);
    out[begin] = std::byte{0xec};
    out[begin + 1] = std::byte{0x01};  // a size of eight bytes
    for (std::size_t i = 0; i < 7; ++i)
        out[begin + 2 + i] = std::byte((size - void_head_size) >> (8 * (6 - i)));
}

Bytes make_head_copy(ByteView head) {
    Bytes content;
    ByteWriter out(content);
    out.put_bytes(as_bytes(head_copy_magic));
    out.put(crc32c(head));
    out.put(std::uint32_t(head.size()));
    out.put_bytes(head);
    Bytes copy;
    render_void(void_head_size + content.size(), copy);
    std::copy(content.begin(), content.end(), copy.begin() + void_head_size);
    return copy;
}

Bytes render_segment_size(std::uint64_t size) {
    Bytes bytes(8);
    bytes[0] = std::byte{0x01};
    for (std::size_t i = 1; i < 8; ++i)
        bytes[i] = std::byte(size >> (8 * (7 - i)));
    return bytes;
}
void render_seek_head(const std::map<std::string, std::uint64_t>& places, std::uint64_t segment,
                      Bytes& out) {
    Empty<KaxSeekHead> head;
    const auto point_at = [&](const char* name, const EbmlId& id) {
        const auto place = places.find(name);
        if (place == places.end())
            return;
        auto& seek = add<KaxSeek>(head);
        binary bytes[4];
        id.Fill(bytes);
        add<KaxSeekID>(seek).CopyBuffer(bytes, uint32(EBML_ID_LENGTH(id)));
        add_number<KaxSeekPosition>(seek, place->second - segment);
    };
    point_at("info", EBML_ID(KaxInfo));
    point_at("tracks", EBML_ID(KaxTracks));
    point_at("attachments", EBML_ID(KaxAttachments));
    point_at("tags", EBML_ID(KaxTags));
    point_at("cues", EBML_ID(KaxCues));
    render(head, out);
}

void render_cluster(std::span<const Block> blocks, Bytes& out) {
    const std::int64_t begin_us = blocks.front().time_us;
    KaxSegment segment;
    Empty<KaxCluster> cluster;
    cluster.SetParent(segment);
    cluster.InitTimecode(std::uint64_t(begin_us), ns_per_tick);
    add_number<KaxClusterTimecode>(cluster, std::uint64_t(begin_us));

    for (const Block& block : blocks) {
        // Only the number and the time's scale of the track are asked for.
        Empty<KaxTrackEntry> track;
        track.SetGlobalTimecodeScale(ns_per_tick);
        add_number<KaxTrackNumber>(track, std::uint64_t(block.track));

        auto& group = add<KaxBlockGroup>(cluster);
        group.SetParent(cluster);
        auto& kax = GetChild<KaxBlock>(group);  // SetParent() has made it
        kax.SetParent(cluster);
        // The library only reads the bytes, and frees but the small object.
        auto* payload = reinterpret_cast<binary*>(const_cast<std::byte*>(block.payload.data()));
        kax.AddFrame(track, std::uint64_t(block.time_us * ns_per_tick),
                     *new DataBuffer(payload, uint32(block.payload.size())), LACING_NONE);
        if (!block.side.empty() || !block.note.empty() || block.check) {
            auto& additions = add<KaxBlockAdditions>(group);
            const auto add_more = [&](int id, ByteView bytes) {
                if (bytes.empty())
                    return;
                // Not by add(): it would find the one before.
                auto& more = *new Empty<KaxBlockMore>;
                additions.PushElement(more);
                add_number<KaxBlockAddID>(more, std::uint64_t(id));
                add_bytes<KaxBlockAdditional>(more, bytes);
            };
            add_more(side_id, block.side);
            add_more(note_id, as_bytes(block.note));
            if (block.check)
                add_more(check_id, *block.check);
        }
        if (!block.key)
            add<KaxReferenceBlock>(group).SetReferencedTimecode(block.reference_us - block.time_us);
    }
    render(cluster, out);
}

void render_cue(const MatroskaCue& cue, Bytes& out) {
    Empty<KaxCuePoint> point;
    add_number<KaxCueTime>(point, std::uint64_t(cue.time_us));
    auto& position = add<KaxCueTrackPositions>(point);
    add_number<KaxCueTrack>(position, std::uint64_t(cue.track));
    add_number<KaxCueClusterPosition>(position, cue.cluster);
    render(point, out);
}

}  // namespace theatron::record
