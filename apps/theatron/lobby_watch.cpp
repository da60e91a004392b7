// SPDX-License-Identifier: Apache-2.0
#include "lobby_watch.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "files/file_bytes.h"
#include "files/png_file.h"
#include "host/lobby.h"

namespace theatron::app {

struct LobbyWatch::Shared {
    std::mutex mutex;
    std::condition_variable changed;
    std::function<void()> news;  // none once the owner has gone
    std::optional<net::Link> link;
    std::uint64_t version = 0;  // of link
    std::optional<Answer> answer;
};

LobbyWatch::LobbyWatch(std::function<void()> news) : shared_(std::make_shared<Shared>()) {
    shared_->news = std::move(news);
    std::thread([shared = shared_] { run(*shared); }).detach();
}

LobbyWatch::~LobbyWatch() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->news = nullptr;
    }
    shared_->changed.notify_all();
}

void LobbyWatch::set_link(const std::optional<net::Link>& link) {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->link = link;
        ++shared_->version;
        shared_->answer.reset();
    }
    shared_->changed.notify_all();
}

std::optional<LobbyWatch::Answer> LobbyWatch::take() {
    const std::lock_guard lock(shared_->mutex);
    return std::exchange(shared_->answer, std::nullopt);
}

LobbyWatch::Answer LobbyWatch::ask(const net::Link& link) {
    Answer answer;
    try {
        answer.lobby = host::lobby_of_host(link, patience);
        const auto png = host::thumbnail_of_host(link, patience);
        if (png && !files::decode_png(as_bytes(*png), answer.picture).empty())
            answer.picture = {};
    } catch (const std::exception& error) {
        if (answer.lobby.is_null())
            answer.problem = error.what();
    }
    return answer;
}

void LobbyWatch::run(Shared& shared) {
    std::unique_lock lock(shared.mutex);
    while (shared.news) {
        const std::uint64_t version = shared.version;
        if (const auto link = shared.link) {
            lock.unlock();
            Answer answer = ask(*link);
            lock.lock();
            if (version == shared.version && shared.news) {
                shared.answer = std::move(answer);
                shared.news();
            }
        }
        shared.changed.wait_for(lock, interval,
                                [&] { return !shared.news || version != shared.version; });
    }
}

}  // namespace theatron::app
