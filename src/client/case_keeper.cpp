// SPDX-License-Identifier: Apache-2.0
#include "client/case_keeper.h"

#include <algorithm>
#include <utility>

#include "base/fault.h"
#include "base/thread_name.h"
#include "medical/picture.h"
#include "net/content_digest.h"
#include "phrases/phrase.h"
#include "session/case_objects.h"

namespace theatron::client {
namespace {

using Failure = session::ContentFetch::Failure;

std::string text_of(Failure failure, bool is_recorded) {
    switch (failure) {
        case Failure::not_there:
            return say(is_recorded ? Phrase::recorded_case_gone : Phrase::case_gone);
        case Failure::wrong_size:
        case Failure::wrong_bytes:
            break;
    }
    return say(Phrase::case_is_other);
}

struct FoundCase {
    ContentHash hash;
    bool is_recorded = false;
    bool operator==(const FoundCase&) const = default;
};

std::optional<FoundCase> open_case(const session::RoomObjects& objects) {
    std::optional<FoundCase> open;
    for (const auto& [id, object] : objects)
        if (object.kind == session::ObjectKind::organ)
            if (const auto organ =
                    session::decode_as<session::CaseOrgan>(object.kind, object.properties)) {
                open = FoundCase{organ->of_case, session::is_recorded(id)};
                // The present case comes before that of a recording.
                if (!open->is_recorded)
                    break;
            }
    return open;
}

}  // namespace

bool OpenCase::is_complete() const {
    const auto is_there = [](const auto& content) { return content != nullptr; };
    return description && std::all_of(meshes.begin(), meshes.end(), is_there) &&
           std::all_of(volumes.begin(), volumes.end(), is_there) &&
           std::all_of(pictures.begin(), pictures.end(), is_there);
}

CaseKeeper::CaseKeeper(std::function<void()> changed, std::function<void()> requests)
    : changed_(std::move(changed)),
      requests_(std::move(requests)),
      fetch_(net::make_content_digest) {
    if constexpr (has_threads)
        thread_ = std::thread([this] {
            name_this_thread("case");
            run();
        });
}

CaseKeeper::~CaseKeeper() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    work_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

void CaseKeeper::on_connected() {
    const std::lock_guard lock(mutex_);
    fetch_.on_connected();
    offered_.clear();
}

void CaseKeeper::on_offer(std::vector<wire::OfferedCase> cases) {
    {
        const std::lock_guard lock(mutex_);
        offered_ = std::move(cases);
        fetch_.retry();
        ++version_;
    }
    changed_();
}

void CaseKeeper::on_room(const session::RoomObjects& objects) {
    const auto found = open_case(objects);
    const auto open = found ? std::optional(found->hash) : std::nullopt;
    const bool is_recorded = found && found->is_recorded;
    {
        const std::lock_guard lock(mutex_);
        if (open == open_ && is_recorded == is_recorded_)
            return;
        open_ = open;
        is_recorded_ = is_recorded;
        ++version_;
        waiting_.clear();
        want();
    }
    requests_();
    changed_();
}

std::shared_ptr<const medical::SharedCase> CaseKeeper::description() const {
    const auto found = open_ ? kept_.find(*open_) : kept_.end();
    const auto* about =
        found == kept_.end()
            ? nullptr
            : std::get_if<std::shared_ptr<const medical::SharedCase>>(&found->second.content);
    return about ? *about : nullptr;
}

// The description first, then organs and pictures, then images, which are larger.
void CaseKeeper::want() {
    std::vector<session::ContentFetch::Wanted> wanted;
    const auto add = [&](const ContentHash& hash, std::uint64_t size, bool exact) {
        const bool waits = std::any_of(waiting_.begin(), waiting_.end(),
                                       [&](const Waiting& w) { return w.hash == hash; });
        if (!waits && !kept_.contains(hash))
            wanted.push_back({hash, size, exact});
    };
    if (open_)
        add(*open_, max_description_bytes, false);
    const auto about = description();
    if (about && about->content_bytes() <= max_case_bytes) {
        for (const medical::SharedPart& part : about->parts)
            add(part.mesh.hash, part.mesh.size, true);
        for (const medical::SharedPicture& picture : about->pictures)
            add(picture.picture.hash, picture.picture.size, true);
        for (const medical::SharedSeries& series : about->series)
            add(series.volume.hash, series.volume.size, true);
        forget_others();
    }
    fetch_.want(std::move(wanted));
}

// Content of cases that were open before is kept while there is room for it.
void CaseKeeper::forget_others() {
    std::uint64_t others = 0;
    for (const auto& [hash, kept] : kept_)
        others += kind_of(hash) ? 0 : kept.size;
    if (others + description()->content_bytes() > max_case_bytes)
        std::erase_if(kept_, [&](const auto& entry) { return !kind_of(entry.first); });
}

std::optional<CaseKeeper::Kind> CaseKeeper::kind_of(const ContentHash& hash) const {
    if (open_ == hash)
        return Kind::description;
    if (const auto about = description()) {
        for (const medical::SharedPart& part : about->parts)
            if (part.mesh.hash == hash)
                return Kind::mesh;
        for (const medical::SharedSeries& series : about->series)
            if (series.volume.hash == hash)
                return Kind::volume;
        for (const medical::SharedPicture& picture : about->pictures)
            if (picture.picture.hash == hash)
                return Kind::picture;
    }
    return std::nullopt;
}

void CaseKeeper::on_content(const wire::Content& piece, TimePoint now) {
    bool changed = false;
    {
        const std::lock_guard lock(mutex_);
        const std::size_t failures = fetch_.failures().size();
        auto complete = fetch_.on_content(piece, now);
        changed = fetch_.failures().size() != failures;
        version_ += changed;
        const auto kind = complete ? kind_of(complete->hash) : std::nullopt;
        if (kind) {
            waiting_.push_back({complete->hash, *kind, std::move(complete->bytes)});
            work_.notify_one();
        }
    }
    if constexpr (!has_threads) {
        std::unique_lock lock(mutex_);
        while (!waiting_.empty())
            decode_next(lock);
    }
    requests_();
    if (changed)
        changed_();
}

std::vector<wire::RequestContent> CaseKeeper::take_requests(TimePoint now) {
    const std::lock_guard lock(mutex_);
    return fetch_.take_requests(now);
}

CaseKeeper::Content CaseKeeper::decode(const Waiting& waiting) {
    Status problem = Status::ok;
    const auto decoded = [&](auto result) -> Content {
        using T = std::decay_t<decltype(*result)>;
        if (result)
            return std::make_shared<const T>(std::move(*result));
        problem = result.error();
        return std::string();
    };
    Content content;
    switch (waiting.kind) {
        case Kind::description: {
            auto about = medical::decode_shared_case(waiting.bytes);
            if (about && about->content_bytes() > max_case_bytes)
                return say(Phrase::case_too_large, std::to_string(max_case_bytes >> 20));
            content = decoded(std::move(about));
            break;
        }
        case Kind::mesh:
            content = decoded(medical::decode_mesh(waiting.bytes));
            break;
        case Kind::volume:
            content = decoded(medical::decode_volume(waiting.bytes));
            break;
        case Kind::picture:
            content = decoded(medical::decode_picture(waiting.bytes));
            break;
    }
    if (problem == Status::unsupported_version)
        return say(Phrase::case_too_new);
    if (problem != Status::ok)
        return say(Phrase::case_unreadable);
    return content;
}

void CaseKeeper::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        work_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
        if (stopping_)
            return;
        if (!contain("case", [&] { decode_next(lock); }) && !lock.owns_lock())
            lock.lock();
    }
}

// `lock` is held; there is content that waits.
void CaseKeeper::decode_next(std::unique_lock<std::mutex>& lock) {
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    Content content = say(Phrase::case_needs_memory);
    (void)contain("case", [&] { content = decode(next); });
    lock.lock();
    kept_[next.hash] = {std::move(content), next.bytes.size()};
    ++version_;
    want();
    lock.unlock();
    requests_();
    changed_();
    lock.lock();
}

std::vector<wire::OfferedCase> CaseKeeper::offered() const {
    const std::lock_guard lock(mutex_);
    return offered_;
}

std::optional<OpenCase> CaseKeeper::open(std::uint64_t& version) const {
    const std::lock_guard lock(mutex_);
    version = version_;
    if (!open_)
        return std::nullopt;
    OpenCase open{*open_, std::nullopt, {}, {}, {}, fetch_.progress(), ""};
    if (!fetch_.failures().empty())
        open.problem = text_of(fetch_.failures().begin()->second, is_recorded_);
    const auto find = [&]<class T>(const ContentHash& hash, T& content) {
        const auto found = kept_.find(hash);
        if (found == kept_.end())
            return;
        if (const auto* known = std::get_if<T>(&found->second.content))
            content = *known;
        else if (const auto* problem = std::get_if<std::string>(&found->second.content))
            open.problem = *problem;
    };
    std::shared_ptr<const medical::SharedCase> about;
    find(*open_, about);
    if (!about)
        return open;
    open.description = *about;
    open.meshes.resize(about->parts.size());
    open.volumes.resize(about->series.size());
    open.pictures.resize(about->pictures.size());
    for (std::size_t i = 0; i < about->parts.size(); ++i)
        find(about->parts[i].mesh.hash, open.meshes[i]);
    for (std::size_t i = 0; i < about->series.size(); ++i)
        find(about->series[i].volume.hash, open.volumes[i]);
    for (std::size_t i = 0; i < about->pictures.size(); ++i)
        find(about->pictures[i].picture.hash, open.pictures[i]);
    return open;
}

}  // namespace theatron::client
