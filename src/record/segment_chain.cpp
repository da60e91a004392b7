// SPDX-License-Identifier: Apache-2.0
#include "record/segment_chain.h"

#include <algorithm>

#include "base/error.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

std::uint32_t number_of(const std::optional<SegmentInfo>& info) {
    return info ? info->number : 1;
}

// A segment has cameras or at least a room.
bool is_recording(const FoundHead& head) {
    return std::any_of(head.tracks.begin(), head.tracks.end(), [](const FoundTrack& t) {
        return t.codec_id == depth_codec_id || t.codec_id == room_codec_id;
    });
}

// A copy of the head that was found elsewhere must not be that of another file which stands behind
// this one.
Result<FoundHead> read_own_head(const std::shared_ptr<ByteSource>& source) {
    Result<FoundHead> head = read_head(*source);
    if (!head || !head->damaged)
        return head;
    const auto next = read_clusters(*source, *head, [](const FoundBlock&) {}).next_file_at;
    if (!next)
        return head;
    PartSource own(source, 0, *next);
    return read_head(own);
}

// True if the head gives an end before `size`, and the end of a closed file is there. With only one
// of the two conditions, pictures of one recording could be taken for another's.
bool ends_before(const std::shared_ptr<PartSource>& file, const FoundHead& head,
                 std::uint64_t size) {
    if (head.segment_end == 0 || head.segment_end >= size)
        return false;
    PartSource own(file, 0, head.segment_end);
    return read_clusters(own, head, [](const FoundBlock&) {}).has_end;
}

}  // namespace

std::optional<SegmentInfo> segment_info_of(const FoundHead& head) {
    for (const FoundAttachment& attachment : head.attachments)
        if (attachment.name == segment_info_name)
            if (const auto info = decode_segment_info(attachment.bytes))
                return *info;
    return std::nullopt;
}

std::optional<SegmentInfo> read_segment_info(const std::filesystem::path& file, CopySearch search) {
    try {
        const Result<FoundHead> head = read_head(*open_file_source(file), search);
        return head ? segment_info_of(*head) : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

Result<SegmentChain> SegmentChain::read(std::vector<std::unique_ptr<ByteSource>> sources,
                                        std::vector<std::string> files) {
    files.resize(sources.size());
    SegmentChain chain;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const std::shared_ptr<ByteSource> source = std::move(sources[i]);
        if (!source) {
            chain.unreadable_.push_back(std::move(files[i]));
            continue;
        }
        Result<FoundHead> head = read_own_head(source);
        if (!head) {
            if (i == 0)
                return head.error();
            // By its name the file belongs to the recording. Another program's Matroska file has
            // another scale of time; nothing else is known of the others.
            const bool is_foreign = head.error() == Status::unsupported;
            (is_foreign ? chain.foreign_ : chain.unreadable_).push_back(std::move(files[i]));
            continue;
        }
        const auto info = segment_info_of(*head);
        if (i == 0)
            chain.first_ = info;
        else if (!chain.follows(info, number_of(chain.first_))) {
            chain.foreign_.push_back(std::move(files[i]));
            continue;
        }
        // If there are two copies of a segment, the first one is used.
        chain.waiting_.try_emplace(number_of(info),
                                   Member{source, std::move(*head), info, std::move(files[i])});
    }
    return chain;
}

bool SegmentChain::follows(const std::optional<SegmentInfo>& info, std::uint32_t number) const {
    return info && first_ && info->recording == first_->recording && info->number > number;
}

std::optional<SegmentChain::Member> SegmentChain::take() {
    if (waiting_.empty())
        return std::nullopt;
    Member member = std::move(waiting_.extract(waiting_.begin()).mapped());
    last_ = number_of(member.info);
    ++taken_;
    has_next_ = member.head.next_segment != 0;
    knows_extent_ |= has_next_;
    return member;
}

SegmentChain::Behind SegmentChain::add_behind(const Member& taken, std::uint64_t at) {
    Behind behind;
    Foreign& foreign = behind.foreign;
    const std::uint64_t end = taken.source->size();
    for (std::optional<std::uint64_t> next = at; next;) {
        const std::uint64_t begin = *next;
        const auto rest = std::make_shared<PartSource>(taken.source, begin, end);
        Result<FoundHead> head = read_head(*rest, CopySearch::at_the_beginning);
        const auto info = head ? segment_info_of(*head) : std::nullopt;
        // Its own head is a part of its file that was written once more, unless the file was closed
        // before.
        const bool was_closed = taken.head.segment_end > 0 && taken.head.segment_end <= begin;
        if (info && info == taken.info && !was_closed) {
            behind.repeated_head_bytes = head->clusters_at;
            behind.goes_on_at = begin + head->clusters_at;
            break;
        }
        next =
            read_clusters(*rest, head ? *head : FoundHead{}, [](const FoundBlock&) {}).next_file_at;
        if (next)
            *next += begin;
        std::uint64_t size = next.value_or(end) - begin;
        if (head && ends_before(rest, *head, size)) {
            size = head->segment_end;
            behind.goes_on_at = begin + size;
            next.reset();
        }
        const bool is_further = follows(info, last_);
        const auto known = is_further ? waiting_.find(info->number) : waiting_.end();
        // The same segment may lie beside the file in a file of its own.
        const bool is_copy = known != waiting_.end() && known->second.file != taken.file;
        const bool is_new = is_further && (known == waiting_.end() ||
                                           (is_copy && known->second.source->size() <= size));
        if (is_new) {
            auto own = std::make_shared<PartSource>(taken.source, begin, begin + size);
            waiting_.insert_or_assign(info->number, Member{std::move(own), std::move(*head), info,
                                                           taken.file, taken.begin + begin});
        } else if (!is_copy) {
            foreign.add({1, size, taken.begin + begin, size, head && is_recording(*head)});
        }
    }
    return behind;
}

std::uint64_t SegmentChain::missing() const {
    const std::uint64_t absent = last_ - number_of(first_) + 1 - taken_ + has_next_;
    return knows_extent_ ? absent : std::max<std::uint64_t>(absent, unreadable_.size());
}

}  // namespace theatron::record
