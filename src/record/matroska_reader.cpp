// SPDX-License-Identifier: Apache-2.0
#include "record/matroska_reader.h"

#include <array>
#include <limits>
#include <optional>

#include "record/matroska_ids.h"

namespace theatron::record {
namespace {

// Headers of blocks lie between images: a small window spares most system calls.
class Window {
public:
    explicit Window(ByteSource& source) : source_(source) {}

    std::uint64_t size() const { return source_.size(); }

    bool read(std::uint64_t at, std::span<std::byte> out) {
        if (out.size() > bytes_.size())
            return source_.read(at, out);
        if (at < begin_ || at + out.size() > begin_ + filled_) {
            if (at > size())
                return false;
            filled_ = std::size_t(std::min<std::uint64_t>(bytes_.size(), size() - at));
            begin_ = at;
            if (out.size() > filled_ ||
                !source_.read(at, std::span<std::byte>(bytes_).first(filled_))) {
                filled_ = 0;
                return false;
            }
        }
        std::copy_n(bytes_.begin() + std::ptrdiff_t(at - begin_), out.size(), out.begin());
        return true;
    }

private:
    ByteSource& source_;
    std::array<std::byte, 1024> bytes_;
    std::uint64_t begin_ = 0;
    std::size_t filled_ = 0;
};

struct Element {
    std::uint32_t id = 0;
    std::uint64_t begin = 0;  // of its content
    std::uint64_t end = 0;    // at most the end of its parent
    bool size_known = true;

    std::uint64_t size() const { return end - begin; }
};

// Reads the head of the element at `at`, which must end before `end`.
Result<Element> read_element(Window& window, std::uint64_t at, std::uint64_t end) {
    const auto byte_at = [&](std::uint64_t where, unsigned& value) {
        std::byte b;
        if (where >= end || !window.read(where, {&b, 1}))
            return false;
        value = std::to_integer<unsigned>(b);
        return true;
    };
    unsigned first = 0;
    if (!byte_at(at, first))
        return Status::truncated;
    Element element;
    int length = 1;
    while (length <= 4 && !(first & (0x100u >> length)))
        ++length;
    if (length > 4)
        return Status::malformed;
    element.id = first;
    for (int i = 1; i < length; ++i) {
        unsigned next = 0;
        if (!byte_at(at + std::uint64_t(i), next))
            return Status::truncated;
        element.id = element.id << 8 | next;
    }

    at += std::uint64_t(length);
    if (!byte_at(at, first))
        return Status::truncated;
    length = 1;
    while (length <= 8 && !(first & (0x100u >> length)))
        ++length;
    if (length > 8)
        return Status::malformed;
    std::uint64_t size = first & ((0x100u >> length) - 1);
    for (int i = 1; i < length; ++i) {
        unsigned next = 0;
        if (!byte_at(at + std::uint64_t(i), next))
            return Status::truncated;
        size = size << 8 | next;
    }
    element.begin = at + std::uint64_t(length);
    element.size_known = size != (std::uint64_t(1) << (7 * length)) - 1;
    element.end = end;
    if (element.size_known) {
        if (size > end - element.begin)
            return Status::truncated;
        element.end = element.begin + size;
    }
    return element;
}

// Calls `visit` for each child in turn, until one is refused.
template <class Visit>
Status for_each_child(Window& window, const Element& parent, Visit visit) {
    for (std::uint64_t at = parent.begin; at < parent.end;) {
        const Result<Element> child = read_element(window, at, parent.end);
        if (!child)
            return child.error();
        if (!child->size_known)
            return Status::malformed;
        if (const Status status = visit(*child); status != Status::ok)
            return status;
        at = child->end;
    }
    return Status::ok;
}

Status read_unsigned(Window& window, const Element& element, std::uint64_t& value) {
    std::array<std::byte, 8> bytes;
    if (element.size() > bytes.size())
        return Status::malformed;
    const std::size_t size = std::size_t(element.size());
    if (!window.read(element.begin, std::span(bytes).first(size)))
        return Status::truncated;
    value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    return Status::ok;
}

// The front as a whole is bounded, so each part is.
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

// The head of a block's content: track as a one-byte number (the writer has no
// more than 126), 16 bits of time, flags without lacing.
Status read_block(Window& window, const Element& element, std::int64_t cluster_us,
                  FoundBlock& block) {
    std::array<std::byte, 4> head;
    if (element.size() < head.size())
        return Status::truncated;
    if (!window.read(element.begin, head))
        return Status::truncated;
    const auto byte = [&](int i) { return std::to_integer<unsigned>(head[std::size_t(i)]); };
    if (!(byte(0) & 0x80) || byte(0) == 0xff)
        return Status::unsupported;
    constexpr unsigned lacing = 0x06;
    if (byte(3) & lacing)
        return Status::unsupported;
    block.track = int(byte(0) & 0x7f);
    block.time_us = cluster_us + std::int16_t(byte(1) << 8 | byte(2));
    block.payload_at = element.begin + head.size();
    if (element.end - block.payload_at > std::numeric_limits<std::uint32_t>::max())
        return Status::too_large;
    block.payload_size = std::uint32_t(element.end - block.payload_at);
    return Status::ok;
}

Status read_additions(Window& window, const Element& additions, FoundBlock& block) {
    return for_each_child(window, additions, [&](const Element& more) {
        if (more.id != ids::block_more)
            return Status::ok;
        std::uint64_t id = 1;  // if not given
        std::optional<Element> bytes;
        const Status status = for_each_child(window, more, [&](const Element& e) {
            if (e.id == ids::block_add_id)
                return read_unsigned(window, e, id);
            if (e.id == ids::block_additional)
                bytes = e;
            return Status::ok;
        });
        constexpr std::uint64_t our_side = 2, our_note = 3;
        constexpr std::uint64_t max_side = 1 << 16;
        if (status != Status::ok || !bytes || bytes->size() > max_side)
            return status;
        if (id == our_side) {
            block.side_at = bytes->begin;
            block.side_size = std::uint32_t(bytes->size());
        } else if (id == our_note) {
            block.note_at = bytes->begin;
            block.note_size = std::uint32_t(bytes->size());
        }
        return status;
    });
}

Status read_group(Window& window, const Element& group, std::int64_t cluster_us,
                  std::vector<FoundBlock>& blocks) {
    FoundBlock found;
    bool has_block = false;
    const Status status = for_each_child(window, group, [&](const Element& e) {
        switch (e.id) {
            case ids::block:
                has_block = true;
                return read_block(window, e, cluster_us, found);
            case ids::reference_block:
                found.key = false;
                return Status::ok;
            case ids::block_additions:
                return read_additions(window, e, found);
            default:
                return Status::ok;
        }
    });
    if (status == Status::ok && has_block)
        blocks.push_back(found);
    return status;
}

// Adds the cluster's blocks only if all of it is understood.
Status read_cluster(Window& window, const Element& cluster, std::vector<FoundBlock>& blocks) {
    const std::size_t before = blocks.size();
    std::int64_t time_us = -1;
    const Status status = for_each_child(window, cluster, [&](const Element& e) -> Status {
        if (blocks.size() >= max_blocks)
            return Status::too_large;
        if (e.id == ids::cluster_timestamp) {
            std::uint64_t value = 0;
            const Status read = read_unsigned(window, e, value);
            constexpr std::uint64_t max_us = std::uint64_t(1) << 60;
            if (value > max_us)
                return Status::malformed;
            time_us = std::int64_t(value);
            return read;
        }
        if (e.id != ids::block_group && e.id != ids::simple_block)
            return Status::ok;
        if (time_us < 0)
            return Status::malformed;
        if (e.id == ids::block_group)
            return read_group(window, e, time_us, blocks);
        FoundBlock found;
        const Status read = read_block(window, e, time_us, found);
        if (read == Status::ok)
            blocks.push_back(found);
        return read;
    });
    if (status != Status::ok)
        blocks.resize(before);
    return status;
}

Status read_info(Window& window, const Element& info) {
    return for_each_child(window, info, [&](const Element& e) {
        if (e.id != ids::timestamp_scale)
            return Status::ok;
        std::uint64_t ns_per_tick = 0;
        const Status status = read_unsigned(window, e, ns_per_tick);
        return status == Status::ok && ns_per_tick != 1000 ? Status::unsupported : status;
    });
}

Status read_part(Window& window, const Element& part, FoundFile& file) {
    const bool is_front =
        part.id == ids::info || part.id == ids::tracks || part.id == ids::attachments;
    if (is_front && part.end > max_front_bytes)
        return Status::too_large;
    switch (part.id) {
        case ids::info:
            return read_info(window, part);
        case ids::tracks:
            return for_each_child(window, part, [&](const Element& e) {
                if (e.id != ids::track_entry)
                    return Status::ok;
                file.tracks.emplace_back();
                return read_track(window, e, file.tracks.back());
            });
        case ids::attachments:
            return for_each_child(window, part, [&](const Element& e) {
                if (e.id != ids::attached_file)
                    return Status::ok;
                file.attachments.emplace_back();
                return read_attachment(window, e, file.attachments.back());
            });
        case ids::cluster:
            return read_cluster(window, part, file.blocks);
        default:
            return Status::ok;
    }
}

}  // namespace

Result<FoundFile> read_matroska(ByteSource& source) {
    Window window(source);
    const std::uint64_t file_end = window.size();
    std::array<std::byte, 4> magic;
    if (!window.read(0, magic))
        return Status::truncated;
    for (std::size_t i = 0; i < magic.size(); ++i)
        if (magic[i] != std::byte(ids::ebml >> (24 - 8 * i)))
            return Status::malformed;
    const Result<Element> head = read_element(window, 0, file_end);
    if (!head)
        return head.error();
    if (!head->size_known)
        return Status::malformed;
    std::string type;
    const Status in_head = for_each_child(window, *head, [&](const Element& e) {
        return e.id == ids::doc_type ? read_text(window, e, type) : Status::ok;
    });
    if (in_head != Status::ok || type != "matroska")
        return Status::malformed;

    FoundFile file;
    // A segment that is longer than the file was cut off; one of unknown size was never closed.
    Result<Element> segment =
        read_element(window, head->end, std::numeric_limits<std::uint64_t>::max());
    if (!segment)
        return segment.error();
    if (segment->id != ids::segment)
        return Status::malformed;
    file.complete = segment->size_known && segment->end <= file_end;
    segment->end = std::min(segment->end, file_end);
    if (segment->begin > file_end)
        return Status::truncated;

    bool in_front = true;
    file.read_bytes = segment->begin;
    for (std::uint64_t at = segment->begin; at < segment->end;) {
        const Result<Element> part = read_element(window, at, segment->end);
        Status status = part ? Status::ok : part.error();
        if (part && !part->size_known)
            status = Status::unsupported;
        if (status == Status::ok) {
            in_front = in_front && part->id != ids::cluster;
            status = read_part(window, *part, file);
        }
        if (status != Status::ok) {
            // Without its front a file is nothing; later, what was read stays.
            if (in_front && (file.tracks.empty() || status != Status::truncated))
                return status;
            file.complete = false;
            break;
        }
        at = part->end;
        file.read_bytes = at;
    }
    if (file.tracks.empty())
        return Status::truncated;
    return file;
}

}  // namespace theatron::record
