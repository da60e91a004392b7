// SPDX-License-Identifier: Apache-2.0
#include "session/content_fetch.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

void ContentFetch::want(std::vector<Wanted> wanted) {
    const auto is_wanted = [&](const ContentHash& hash) {
        return std::any_of(wanted.begin(), wanted.end(),
                           [&](const Wanted& w) { return w.hash == hash; });
    };
    if (wanted.empty())
        done_bytes_ = 0;
    if (current_ && !is_wanted(current_->wanted.hash))
        current_.reset();
    std::erase_if(failures_, [&](const auto& failure) { return !is_wanted(failure.first); });
    wanted_ = std::move(wanted);
}

void ContentFetch::on_connected() {
    failures_.clear();
    if (current_)
        current_->asked = current_->bytes.size();
}

void ContentFetch::begin_next() {
    for (const Wanted& wanted : wanted_) {
        if (failures_.contains(wanted.hash))
            continue;
        current_ = Current();
        current_->wanted = wanted;
        current_->size = wanted.exact ? wanted.size : 0;
        current_->digest = make_digest_();
        return;
    }
}

std::vector<wire::RequestContent> ContentFetch::take_requests(TimePoint now) {
    std::vector<wire::RequestContent> requests;
    if (!current_)
        begin_next();
    if (!current_)
        return requests;
    Current& current = *current_;
    if (current.asked > current.bytes.size() && now - heard_ > answer_patience)
        current.asked = current.bytes.size();
    // The first answer says how large it is.
    const std::uint64_t size = current.size != 0 ? current.size : current.wanted.size;
    while (current.asked < size) {
        const std::uint64_t count =
            std::min<std::uint64_t>(size - current.asked, wire::max_content_request);
        if (current.asked + count - current.bytes.size() > max_outstanding)
            break;
        const auto& hash = current.wanted.hash.bytes;
        requests.push_back({Bytes(hash.begin(), hash.end()), current.asked, std::uint32_t(count)});
        current.asked += count;
        heard_ = now;
    }
    return requests;
}

void ContentFetch::fail(Failure failure) {
    failures_[current_->wanted.hash] = failure;
    current_.reset();
}

std::optional<ContentFetch::Complete> ContentFetch::on_content(const wire::Content& piece,
                                                               TimePoint now) {
    const auto hash = to_content_hash(piece.hash);
    // A piece of content that was wanted before, or that comes twice after a request was repeated.
    if (!current_ || hash != current_->wanted.hash)
        return std::nullopt;
    Current& current = *current_;
    if (piece.total == 0) {
        fail(Failure::not_there);
        return std::nullopt;
    }
    const bool known = current.size != 0;
    if (known ? piece.total != current.size : piece.total > current.wanted.size) {
        fail(Failure::wrong_size);
        return std::nullopt;
    }
    current.size = piece.total;
    if (piece.offset != current.bytes.size() || piece.bytes.empty())
        return std::nullopt;
    if (piece.bytes.size() > current.size - current.bytes.size()) {
        fail(Failure::wrong_size);
        return std::nullopt;
    }
    heard_ = now;
    // Memory grows with what has come, not with what was announced.
    current.bytes.insert(current.bytes.end(), piece.bytes.begin(), piece.bytes.end());
    current.digest->add(piece.bytes);
    if (current.bytes.size() < current.size)
        return std::nullopt;
    if (current.digest->finish() != *hash) {
        fail(Failure::wrong_bytes);
        return std::nullopt;
    }
    Complete complete{*hash, std::move(current.bytes)};
    std::erase_if(wanted_, [&](const Wanted& wanted) { return wanted.hash == *hash; });
    done_bytes_ += complete.bytes.size();
    current_.reset();
    return complete;
}

ContentFetch::Progress ContentFetch::progress() const {
    Progress progress{done_bytes_, done_bytes_};
    for (const Wanted& wanted : wanted_)
        progress.all += wanted.size;
    if (current_)
        progress.got += current_->bytes.size();
    return progress;
}

}  // namespace theatron::session
