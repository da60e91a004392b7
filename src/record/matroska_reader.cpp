// SPDX-License-Identifier: Apache-2.0
// The clusters of a recording's file: see matroska_reader.h.
#include "record/matroska_reader.h"

#include <algorithm>
#include <array>
#include <limits>

#include "record/ebml_reader.h"
#include "record/matroska_ids.h"
#include "record/matroska_writer.h"

namespace theatron::record {
namespace {

// Elements that may stand beside clusters, in them, and in block groups. In a damaged file a number
// that none of these has is the first sign.
bool is_beside_clusters(std::uint32_t id) {
    switch (id) {
        case ids::seek_head:
        case ids::info:
        case ids::tracks:
        case ids::attachments:
        case ids::cues:
        case ids::chapters:
        case ids::tags:
        case ids::void_element:
        case ids::crc_32:
            return true;
        default:
            return false;
    }
}

bool is_passed_over_in_cluster(std::uint32_t id) {
    switch (id) {
        case ids::cluster_position:
        case ids::previous_size:
        case ids::silent_tracks:
        case ids::void_element:
        case ids::crc_32:
            return true;
        default:
            return false;
    }
}

bool is_passed_over_in_group(std::uint32_t id) {
    switch (id) {
        case ids::reference_block:  // the media header says it
        case ids::block_duration:
        case ids::reference_priority:
        case ids::codec_state:
        case ids::discard_padding:
        case ids::slices:
        case ids::void_element:
        case ids::crc_32:
            return true;
        default:
            return false;
    }
}

// The head of a block's content: the track as a number of one or two bytes, 16 bits of time,
// flags. None of ours has lacing, so flags that say so are damaged; the picture behind them need
// not be.
Status read_block(Window& window, const Element& element, std::int64_t cluster_us,
                  FoundBlock& block) {
    std::array<std::byte, 5> head{};
    const std::size_t there = std::size_t(std::min<std::uint64_t>(element.size(), head.size()));
    if (!window.read(element.begin, std::span(head).first(there)))
        return Status::truncated;
    const auto byte = [&](std::size_t i) { return std::to_integer<unsigned>(head[i]); };
    const std::size_t length = byte(0) & 0x80 ? 1 : 2;
    if (there < length + 3)
        return Status::truncated;
    if (length == 2 && !(byte(0) & 0x40))
        return Status::malformed;
    block.track = length == 1 ? int(byte(0) & 0x7f) : int((byte(0) & 0x3f) << 8 | byte(1));
    block.time_us = cluster_us + std::int16_t(byte(length) << 8 | byte(length + 1));
    block.payload_at = element.begin + length + 3;
    if (element.end - block.payload_at > std::numeric_limits<std::uint32_t>::max())
        return Status::too_large;
    block.payload_size = std::uint32_t(element.end - block.payload_at);
    return Status::ok;
}

template <class Array>
Status read_exactly(Window& window, const Element& element, std::optional<Array>& out) {
    Array bytes;
    if (element.size() != bytes.size())
        return Status::ok;  // as if it were not there
    if (!window.read(element.begin, bytes))
        return Status::truncated;
    out = bytes;
    return Status::ok;
}

Status read_addition(Window& window, std::uint64_t id, const Element& bytes, FoundBlock& block) {
    if (id == side_id) {
        block.side_at = bytes.begin;
        return read_exactly(window, bytes, block.side);
    }
    if (id == check_id)
        return read_exactly(window, bytes, block.check);
    if (id == note_id && bytes.size() <= max_note) {
        block.note.resize(std::size_t(bytes.size()));
        if (!window.read(bytes.begin, std::as_writable_bytes(std::span(block.note))))
            return Status::truncated;
    }
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
        return status == Status::ok && bytes ? read_addition(window, id, *bytes, block) : status;
    });
}

using Visit = std::function<void(const FoundBlock&)>;

Status read_group(Window& window, const Element& group, std::int64_t cluster_us,
                  const Visit& visit) {
    FoundBlock found;
    bool has_block = false;
    const Status status = for_each_child(window, group, [&](const Element& e) {
        if (e.id == ids::block) {
            has_block = true;
            return read_block(window, e, cluster_us, found);
        }
        if (e.id == ids::block_additions)
            return read_additions(window, e, found);
        return is_passed_over_in_group(e.id) ? Status::ok : Status::malformed;
    });
    if (status == Status::ok && has_block)
        visit(found);
    return status;
}

// Visits the cluster's blocks up to the first that is not understood. Returns where that is: the
// cluster's end if there is none.
std::uint64_t read_cluster(Window& window, const Element& cluster, const Visit& visit) {
    std::int64_t time_us = -1;
    std::uint64_t understood = cluster.begin;
    const Status status = for_each_child(window, cluster, [&](const Element& e) -> Status {
        Status read = Status::ok;
        if (e.id == ids::cluster_timestamp) {
            std::uint64_t value = 0;
            read = read_unsigned(window, e, value);
            constexpr std::uint64_t max_us = std::uint64_t(1) << 60;
            if (value > max_us)
                read = Status::malformed;
            time_us = std::int64_t(value);
        } else if (e.id == ids::block_group && time_us >= 0) {
            read = read_group(window, e, time_us, visit);
        } else if (e.id == ids::simple_block && time_us >= 0) {
            FoundBlock found;
            read = read_block(window, e, time_us, found);
            if (read == Status::ok)
                visit(found);
        } else if (!is_passed_over_in_cluster(e.id)) {
            read = Status::malformed;
        }
        if (read == Status::ok)
            understood = e.end;
        return read;
    });
    return status == Status::ok ? cluster.end : understood;
}

// Is this the head of a Matroska file?
bool begins_file(Window& window, std::uint64_t at) {
    const Result<Element> head = read_element(window, at, window.size());
    constexpr std::uint64_t max_head = 256;
    if (!head || head->id != ids::ebml || !head->size_known || head->size() > max_head)
        return false;
    constexpr std::string_view type = "matroska";
    bool found = false;
    const Status status = for_each_child(window, *head, [&](const Element& e) {
        std::array<std::byte, type.size()> text;
        if (e.id == ids::doc_type && e.size() == text.size() && window.read(e.begin, text))
            found = std::ranges::equal(text, as_bytes(type));
        return Status::ok;
    });
    return status == Status::ok && found;
}

constexpr std::array<std::byte, 4> bytes_of(std::uint32_t id) {
    return {std::byte(id >> 24), std::byte(id >> 16 & 0xff), std::byte(id >> 8 & 0xff),
            std::byte(id & 0xff)};
}

struct Place {
    std::uint64_t at = 0;
    bool is_file = false;  // else a cluster, or the end
};

// Where the next cluster or the next file seems to begin, from `at` on; the end if nowhere.
Place find_next(ByteSource& source, std::uint64_t at) {
    constexpr auto cluster = bytes_of(ids::cluster), file = bytes_of(ids::ebml);
    constexpr std::uint64_t chunk = 1 << 16;
    const std::uint64_t end = source.size();
    Window window(source);
    Bytes bytes;
    for (; at + cluster.size() <= end; at += chunk) {
        bytes.resize(std::size_t(std::min<std::uint64_t>(chunk + cluster.size() - 1, end - at)));
        if (!source.read(at, bytes))
            return {end};
        const auto found = std::search(bytes.begin(), bytes.end(), cluster.begin(), cluster.end());
        for (auto other = bytes.begin();; ++other) {
            other = std::search(other, found, file.begin(), file.end());
            if (other == found)
                break;
            const std::uint64_t place = at + std::uint64_t(other - bytes.begin());
            if (begins_file(window, place))
                return {place, true};
        }
        if (found != bytes.end())
            return {at + std::uint64_t(found - bytes.begin())};
    }
    return {end};
}

// Do the bytes at `at`, which are no whole element, begin with the id of one that stands beside
// clusters?
bool begins_beside_clusters(Window& window, std::uint64_t at) {
    std::uint32_t id = 0;
    for (std::uint64_t i = 0; i < 4; ++i) {
        std::byte next;
        if (!window.read(at + i, {&next, 1}))
            return false;
        id = id << 8 | std::to_integer<std::uint32_t>(next);
        if (is_beside_clusters(id))
            return true;
    }
    return false;
}

}  // namespace

FoundClusters read_clusters(ByteSource& source, const FoundHead& head, const Visit& visit) {
    Window window(source);
    FoundClusters found;
    const std::uint64_t end = window.size();
    // The file's own head may be behind foreign bytes or behind damage.
    bool is_own_head = head.clusters_at == 0;
    // Nothing before this is looked at again, so the time is proportional to the size.
    std::uint64_t understood = head.clusters_at;
    bool has_index = false, has_end = false;
    for (std::uint64_t at = head.clusters_at; at < end;) {
        const Result<Element> element = read_element(window, at, end);
        const bool whole = element && element->size_known;
        const bool is_head = whole && element->id == ids::ebml && begins_file(window, at);
        bool in_clusters = true;
        if (whole && element->id == ids::cluster) {
            is_own_head = has_index = has_end = false;
            understood = read_cluster(window, *element, visit);
            at = element->end;
            if (understood == element->end)
                continue;
        } else if (whole && is_beside_clusters(element->id)) {
            // Its size may be damaged: `understood` stays until a cluster follows.
            at = element->end;
            has_end = has_index && element->id == ids::void_element;
            has_index = has_index || element->id == ids::cues;
            found.has_end = has_end && at == end;
            if (at == end)
                return found;
            continue;
        } else if (is_head && !is_own_head) {
            found.has_end = has_end;
            found.next_file_at = at;
            return found;
        } else {
            is_own_head = is_own_head && !is_head;
            understood = std::max(understood, head.clusters_at);
            in_clusters = !has_index && !begins_beside_clusters(window, at);
        }
        Place next = find_next(source, understood + (understood == at ? 1 : 0));
        while (next.is_file && is_own_head) {
            is_own_head = false;
            next = find_next(source, next.at + 1);
        }
        at = next.at;
        const std::uint64_t lost = at - understood;
        // Not even the smallest cluster has room in so few bytes, which may have been inserted.
        constexpr std::uint64_t slack = 8;
        const bool is_front = understood == 0 && at <= head.front_end + slack;
        understood = at;
        if (is_front && !next.is_file)
            continue;
        // Incomplete bytes at the end of an unclosed file come from a crash or a cut: no damage.
        if ((at == end || next.is_file) && !head.closed) {
            found.cut_bytes = lost;
            found.cut_in_clusters = in_clusters && lost > 0;
        } else {
            ++found.damaged_places;
            found.damaged_bytes += lost;
        }
        if (next.is_file) {
            found.next_file_at = at;
            return found;
        }
    }
    return found;
}

}  // namespace theatron::record
