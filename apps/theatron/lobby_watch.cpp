// SPDX-License-Identifier: Apache-2.0
#include "lobby_watch.h"

#include <exception>
#include <utility>

#include "files/file_bytes.h"
#include "files/png_file.h"
#include "host/lobby.h"

namespace theatron::app {

LobbyWatch::LobbyWatch(std::function<void()> news)
    : news_(std::move(news)), thread_([this] { run(); }) {}

LobbyWatch::~LobbyWatch() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LobbyWatch::set_link(const std::optional<net::Link>& link) {
    {
        const std::lock_guard lock(mutex_);
        link_ = link;
        ++version_;
        answer_.reset();
    }
    changed_.notify_all();
}

std::optional<LobbyWatch::Answer> LobbyWatch::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
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

void LobbyWatch::run() {
    std::unique_lock lock(mutex_);
    while (!ends_) {
        const std::uint64_t version = version_;
        if (const auto link = link_) {
            lock.unlock();
            Answer answer = ask(*link);
            lock.lock();
            if (version == version_) {
                answer_ = std::move(answer);
                lock.unlock();
                news_();
                lock.lock();
            }
        }
        changed_.wait_for(lock, interval, [&] { return ends_ || version != version_; });
    }
}

}  // namespace theatron::app
