// SPDX-License-Identifier: Apache-2.0
// The head of a recording's file: see matroska_reader.h.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "record/crc32c.h"
#include "record/ebml_reader.h"
#include "record/matroska_ids.h"
#include "record/matroska_reader.h"
#include "record/matroska_writer.h"
#include "record/recording_layout.h"
#include "record/segment_info.h"

namespace theatron::record {
namespace {

// The head as a whole is bounded, so each part is.
Status read_bytes(Window& window, const Element& element, Bytes& value) {
    if (element.size() > max_front_bytes)
        return Status::too_large;
    value.resize(std::size_t(element.size()));
    return window.read(element.begin, value) ? Status::ok : Status::truncated;
}

Status read_text(Window& window, const Element& element, std::string& value) {
    constexpr std::uint64_t max_text = 4096;
    if (element.size() > max_text)
        return Status::too_large;
    Bytes bytes;
    const Status status = read_bytes(window, element, bytes);
    value.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    value.resize(std::min(value.size(), value.find('\0')));  // padding
    return status;
}

Status read_side_of(Window& window, const Element& list, int& number) {
    std::uint64_t value = 0;
    const Status status = read_unsigned(window, list, value);
    constexpr std::uint64_t max_pixels = 1 << 16;
    if (value > max_pixels)
        return Status::malformed;
    number = int(value);
    return status;
}

Status read_track(Window& window, const Element& entry, FoundTrack& track) {
    return for_each_child(window, entry, [&](const Element& e) {
        switch (e.id) {
            case ids::track_number:
                return read_side_of(window, e, track.number);
            case ids::codec_id:
                return read_text(window, e, track.codec_id);
            case ids::codec_private:
                return read_bytes(window, e, track.codec_private);
            case ids::track_name:
                return read_text(window, e, track.name);
            case ids::default_duration:
                return read_unsigned(window, e, track.default_duration_ns);
            case ids::video:
                return for_each_child(window, e, [&](const Element& v) {
                    if (v.id == ids::pixel_width)
                        return read_side_of(window, v, track.width);
                    if (v.id == ids::pixel_height)
                        return read_side_of(window, v, track.height);
                    return Status::ok;
                });
            default:
                return Status::ok;
        }
    });
}

Status read_attachment(Window& window, const Element& entry, FoundAttachment& attachment) {
    return for_each_child(window, entry, [&](const Element& e) {
        switch (e.id) {
            case ids::file_name:
                return read_text(window, e, attachment.name);
            case ids::file_mime_type:
                return read_text(window, e, attachment.mime_type);
            case ids::file_data:
                return read_bytes(window, e, attachment.bytes);
            default:
                return Status::ok;
        }
    });
}

// Nothing where it is no time: it is only a remark, which nothing checks.
Status read_duration(Window& window, const Element& element, std::int64_t& duration_us) {
    constexpr double credible_us = 1e15;
    std::uint64_t bits = 0;
    if (element.size() != sizeof(bits))
        return Status::ok;
    const Status status = read_unsigned(window, element, bits);
    const auto value = std::bit_cast<double>(bits);
    duration_us = value > 0 && value <= credible_us ? std::int64_t(value) : 0;
    return status;
}

// 0 for what is no number of a segment.
std::uint32_t number_of(const std::string& text) {
    std::uint32_t number = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
    return is_whole && number <= max_segments ? number : 0;
}

Status read_tag(Window& window, const Element& tag, FoundHead& head) {
    return for_each_child(window, tag, [&](const Element& simple) {
        if (simple.id != ids::simple_tag)
            return Status::ok;
        std::string name, value;
        const Status status = for_each_child(window, simple, [&](const Element& e) {
            if (e.id == ids::tag_name)
                return read_text(window, e, name);
            return e.id == ids::tag_string ? read_text(window, e, value) : Status::ok;
        });
        if (name == recovered_tag)
            head.recovered = value;
        if (name == early_end_tag)
            head.early_end = value;
        if (name == lacks_tag)
            head.lacks = value;
        if (name == next_segment_tag)
            head.next_segment = number_of(value);
        return status;
    });
}

Status read_info(Window& window, const Element& info, FoundHead& head) {
    return for_each_child(window, info, [&](const Element& e) {
        std::uint64_t value = 0;
        if (e.id == ids::date_utc) {
            const Status status = read_unsigned(window, e, value);
            head.date_ns = std::int64_t(value);
            return status;
        }
        if (e.id == ids::duration)
            return read_duration(window, e, head.duration_us);
        if (e.id != ids::timestamp_scale)
            return Status::ok;
        const Status status = read_unsigned(window, e, value);
        return status == Status::ok && value != 1000 ? Status::unsupported : status;
    });
}

Status read_part(Window& window, const Element& part, FoundHead& head) {
    switch (part.id) {
        case ids::info:
            return read_info(window, part, head);
        case ids::tracks:
            return for_each_child(window, part, [&](const Element& e) {
                if (e.id != ids::track_entry)
                    return Status::ok;
                head.tracks.emplace_back();
                return read_track(window, e, head.tracks.back());
            });
        case ids::attachments:
            return for_each_child(window, part, [&](const Element& e) {
                if (e.id != ids::attached_file)
                    return Status::ok;
                head.attachments.emplace_back();
                return read_attachment(window, e, head.attachments.back());
            });
        case ids::tags:
            return for_each_child(window, part, [&](const Element& e) {
                return e.id == ids::tag ? read_tag(window, e, head) : Status::ok;
            });
        default:
            return Status::ok;
    }
}

// The copy of the head whose magic is at `magic_at`, if it is intact and has `expected_size` bytes
// (if that is given).
std::optional<FoundHead> read_copy(ByteSource& source, std::uint64_t magic_at,
                                   std::optional<std::uint64_t> expected_size = {}) {
    std::array<std::byte, head_copy_magic.size() + 8> front;
    if (!source.read(magic_at, front) ||
        !std::equal(head_copy_magic.begin(), head_copy_magic.end(), front.begin(),
                    [](char a, std::byte b) { return std::byte(a) == b; }))
        return std::nullopt;
    const auto check = load_le<std::uint32_t>(front.data() + head_copy_magic.size());
    const auto size = load_le<std::uint32_t>(front.data() + head_copy_magic.size() + 4);
    if (size > max_front_bytes || (expected_size && *expected_size != front.size() + size))
        return std::nullopt;
    Bytes bytes(size);
    if (!source.read(magic_at + front.size(), bytes) || crc32c(bytes) != check)
        return std::nullopt;
    MemorySource memory(bytes);
    Window window(memory);
    FoundHead head;
    const Status status =
        for_each_child(window, Element{.end = bytes.size()},
                       [&](const Element& part) { return read_part(window, part, head); });
    head.front_end = bytes_before_info + size + void_head_size + front.size() + size;
    return status == Status::ok && !head.tracks.empty() ? std::optional(head) : std::nullopt;
}

// Calls `visit` with each place of these bytes from `begin` to `end`, until it returns true. The
// result is that of the last call.
template <class Visit>
bool find_bytes(ByteSource& source, std::uint64_t begin, std::uint64_t end, ByteView wanted,
                Visit visit) {
    constexpr std::uint64_t chunk = 1 << 16;
    const std::size_t overlap = wanted.size() - 1;
    Bytes bytes;
    for (std::uint64_t at = begin; at + overlap < end; at += chunk) {
        bytes.resize(std::size_t(std::min<std::uint64_t>(chunk + overlap, end - at)));
        if (!source.read(at, bytes))
            return false;
        for (auto found = bytes.begin();; ++found) {
            found = std::search(found, bytes.end(), wanted.begin(), wanted.end());
            if (found == bytes.end())
                break;
            if (visit(at + std::uint64_t(found - bytes.begin())))
                return true;
        }
    }
    return false;
}

// The first intact copy between two places.
std::optional<FoundHead> find_copy(ByteSource& source, std::uint64_t begin, std::uint64_t end) {
    std::optional<FoundHead> head;
    find_bytes(source, begin, end, as_bytes(head_copy_magic), [&](std::uint64_t at) {
        head = read_copy(source, at);
        return head.has_value();
    });
    return head;
}

// The first of all, those near the ends before the others: a file that is no recording at all is
// not read whole.
std::optional<FoundHead> find_copy(ByteSource& source) {
    const std::uint64_t size = source.size();
    if (size <= 2 * max_front_bytes)
        return find_copy(source, 0, size);
    if (auto head = find_copy(source, 0, max_front_bytes))
        return head;
    if (auto head = find_copy(source, size - max_front_bytes, size))
        return head;
    constexpr std::array cluster{
        std::byte(ids::cluster >> 24), std::byte(ids::cluster >> 16 & 0xff),
        std::byte(ids::cluster >> 8 & 0xff), std::byte(ids::cluster & 0xff)};
    const bool has_clusters =
        find_bytes(source, 0, max_front_bytes, cluster, [](std::uint64_t) { return true; });
    return has_clusters ? find_copy(source, max_front_bytes, size - max_front_bytes) : std::nullopt;
}

struct PlainHead {
    Status status = Status::ok;
    // The elements before Info are not as the writer leaves them.
    bool is_front_damaged = false;
    FoundHead head;                 // the parts before the damage
    std::optional<FoundHead> copy;  // found while reading
};

// As players do: from the first byte to the first cluster.
PlainHead read_plain(ByteSource& source) {
    PlainHead found;
    Window window(source);
    const std::uint64_t file_end = window.size();
    std::array<std::byte, 4> magic;
    if (!window.read(0, magic)) {
        found.status = Status::truncated;
        return found;
    }
    found.status = Status::malformed;
    for (std::size_t i = 0; i < magic.size(); ++i)
        if (magic[i] != std::byte(ids::ebml >> (24 - 8 * i)))
            return found;
    const Result<Element> ebml = read_element(window, 0, file_end);
    if (!ebml) {
        found.status = ebml.error();
        return found;
    }
    std::string type;
    const Status in_head = for_each_child(window, *ebml, [&](const Element& e) {
        return e.id == ids::doc_type ? read_text(window, e, type) : Status::ok;
    });
    if (!ebml->size_known || in_head != Status::ok || type != "matroska")
        return found;

    // A segment that is longer than the file was cut off; one of unknown size was never closed.
    const Result<Element> segment =
        read_element(window, ebml->end, std::numeric_limits<std::uint64_t>::max());
    if (!segment || segment->id != ids::segment) {
        found.status = segment ? Status::malformed : segment.error();
        return found;
    }
    found.head.segment_end = segment->size_known ? segment->end : 0;
    found.head.closed = segment->size_known && segment->end <= file_end;
    const std::uint64_t end = std::min(segment->end, file_end);
    found.head.clusters_at = segment->begin;
    if (segment->begin > file_end) {
        found.status = Status::truncated;
        return found;
    }
    found.status = Status::ok;
    bool has_passed_copy = false;
    for (std::uint64_t at = segment->begin; at < end;) {
        const Result<Element> part = read_element(window, at, end);
        if (part && part->id == ids::cluster)
            break;
        found.status = part ? Status::ok : part.error();
        if (part && (!part->size_known || part->end > max_front_bytes))
            found.status = part->size_known ? Status::too_large : Status::unsupported;
        if (found.status == Status::ok)
            found.status = read_part(window, *part, found.head);
        if (found.status != Status::ok)
            break;
        if (part->end <= segment->begin + seek_head_space) {
            const bool says_something = !found.head.early_end.empty() ||
                                        !found.head.lacks.empty() || found.head.next_segment != 0;
            found.is_front_damaged |=
                part->id == ids::tags ? !says_something
                                      : part->id != ids::seek_head && part->id != ids::void_element;
        }
        // A damaged size of that element would skip clusters, perhaps up to another copy.
        if (part->id == ids::void_element && !found.head.tracks.empty() &&
            !std::exchange(has_passed_copy, true))
            found.copy = read_copy(source, part->begin, part->size());
        at = part->end;
        found.head.clusters_at = at;
    }
    // A file that was cut off after its tracks is a recording without pictures.
    if (found.status == Status::truncated && !found.head.tracks.empty())
        found.status = Status::ok;
    if (found.status == Status::ok && found.head.tracks.empty())
        found.status = Status::truncated;
    return found;
}

bool has_copies(const FoundHead& head) {
    return std::any_of(head.attachments.begin(), head.attachments.end(),
                       [](const FoundAttachment& a) { return a.name == segment_info_name; });
}

}  // namespace

Result<FoundHead> read_head(ByteSource& source, CopySearch search) {
    PlainHead plain = read_plain(source);
    bool plain_is_whole = plain.status == Status::ok;
    if (plain_is_whole && !plain.copy) {
        // A damaged size may have hidden the copy; in version 1 there is none.
        constexpr std::uint64_t near = 2 * second_copy_at;
        if (search == CopySearch::everywhere)
            plain.copy =
                find_copy(source, 0, std::min(source.size(), plain.head.clusters_at + near));
        if (!plain.copy && !has_copies(plain.head))
            return plain.head;
        plain_is_whole = false;
    }
    bool damaged = !plain_is_whole || !plain.copy;
    std::optional<FoundHead> copy = std::move(plain.copy);
    if (!copy && search == CopySearch::everywhere)
        copy = find_copy(source);
    if (!copy) {
        if (plain.status != Status::ok)
            return plain.status;
        plain.head.damaged = true;
        return plain.head;
    }
    damaged = damaged || plain.is_front_damaged || copy->tracks != plain.head.tracks ||
              copy->attachments != plain.head.attachments;
    copy->damaged = damaged;
    copy->early_end = plain.head.early_end;
    copy->lacks = plain.head.lacks;
    copy->next_segment = plain.head.next_segment;
    copy->closed = plain.head.closed;
    copy->segment_end = plain.head.segment_end;
    copy->duration_us = plain.head.duration_us;
    copy->clusters_at = plain_is_whole ? plain.head.clusters_at : 0;
    return *copy;
}

}  // namespace theatron::record
