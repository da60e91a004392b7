// SPDX-License-Identifier: Apache-2.0
#include "world/network.h"

#include <utility>

#include "world/schedule.h"

namespace theatron::world {
namespace {

Schedule& schedule() {
    return Schedule::instance();
}

}  // namespace

void Path::cut() {
    if (std::exchange(is_cut_, true))
        return;
    const std::uint64_t cut = ++cuts_;
    for (const auto& plug : plugs_)
        schedule().after(Plug::longest_silence, [this, plug, cut] {
            if (const auto there = plug.lock(); there && is_cut_ && cuts_ == cut)
                there->fail(Fault::timeout);
        });
}

void Path::mend() {
    is_cut_ = false;
    for (auto& work : std::exchange(at_mend_, {}))
        schedule().after(delay, std::move(work));
}

void Path::reset() {
    for (const auto& plug : std::vector(plugs_))
        if (const auto there = plug.lock())
            there->fail(Fault::reset);
}

std::size_t Path::connections() const {
    std::size_t count = 0;
    for (const auto& plug : plugs_)
        if (const auto there = plug.lock(); there && !there->is_closed_)
            ++count;
    return (count + 1) / 2;
}

Plug::Plug(std::shared_ptr<Path> path, unsigned seed) : path_(std::move(path)), out_(seed) {
    out_.delay = path_->delay;
    out_.bytes_per_second = path_->bytes_per_second;
    out_.loss = path_->loss;
}

std::pair<std::shared_ptr<Plug>, std::shared_ptr<Plug>> Plug::connect(std::shared_ptr<Path> path) {
    const auto a = std::make_shared<Plug>(path, path->next_seed());
    const auto b = std::make_shared<Plug>(path, path->next_seed());
    a->other_ = b;
    b->other_ = a;
    std::erase_if(path->plugs_, [](const auto& plug) { return plug.expired(); });
    path->plugs_.insert(path->plugs_.end(), {a, b});
    return {a, b};
}

void Plug::read(std::function<void(Fault, ByteView)> done) {
    reading_ = std::move(done);
    schedule().after({}, [self = shared_from_this()] { self->try_to_read(); });
}

void Plug::try_to_read() {
    if (!reading_)
        return;
    const Fault fault = is_closed_ ? Fault::aborted : fault_;
    if (fault != Fault::none)
        return std::exchange(reading_, nullptr)(fault, {});
    if (arrived_.empty())
        return;
    if (arrived_.front().empty())
        return std::exchange(reading_, nullptr)(Fault::closed, {});
    const Bytes bytes = std::move(arrived_.front());
    arrived_.pop_front();
    std::exchange(reading_, nullptr)(Fault::none, bytes);
}

void Plug::write(Bytes envelope, std::function<void(Fault)> done) {
    writing_ = std::move(done);
    if (fault_ == Fault::none && !is_closed_)
        send(std::move(envelope));
    const Duration queue(std::int64_t(double(most_unsent) / out_.bytes_per_second * 1e6));
    schedule().at(out_.free_at() - queue, [self = shared_from_this()] { self->finish_write(); });
}

void Plug::finish_write() {
    if (!writing_)
        return;
    if (path_->is_cut() && fault_ == Fault::none && !is_closed_ && under_way_ > most_unsent)
        return path_->at_mend_.push_back([self = shared_from_this()] { self->finish_write(); });
    std::exchange(writing_, nullptr)(is_closed_ ? Fault::aborted : fault_);
}

void Plug::send(Bytes envelope) {
    if (has_ended_)
        return;
    under_way_ += envelope.size();
    out_.send(std::move(envelope), schedule().now());
    schedule().at(out_.newest_arrival(), [self = shared_from_this()] { self->deliver(); });
}

void Plug::deliver() {
    if (fault_ != Fault::none)
        return;
    if (path_->is_cut())
        return path_->at_mend_.push_back([self = shared_from_this()] { self->deliver(); });
    for (Bytes bytes; out_.receive(bytes, schedule().now());) {
        under_way_ -= bytes.size();
        if (const auto other = other_.lock())
            other->arrive(std::move(bytes));
    }
}

void Plug::arrive(Bytes envelope) {
    if (is_closed_)
        return;
    arrived_.push_back(std::move(envelope));
    try_to_read();
}

void Plug::say_end() {
    send({});
    has_ended_ = true;
}

void Plug::close() {
    say_end();
    is_closed_ = true;
    arrived_.clear();
    schedule().after({}, [self = shared_from_this()] {
        self->try_to_read();
        self->finish_write();
    });
}

void Plug::fail(Fault fault) {
    if (fault_ != Fault::none || is_closed_)
        return;
    fault_ = fault;
    schedule().after({}, [self = shared_from_this()] {
        self->try_to_read();
        self->finish_write();
    });
}

Network& Network::instance() {
    static Network only;
    return only;
}

void Network::begin(unsigned seed) {
    seed_ = seed;
    listeners_.clear();
    paths_.clear();
}

std::uint16_t Network::listen(std::uint16_t port, Listener listener) {
    if (port == 0)
        for (port = 40000; !is_free(port); ++port) {
        }
    listeners_[port] = std::move(listener);
    return port;
}

std::shared_ptr<Path> Network::path(const std::string& name) {
    auto& path = paths_[name];
    if (!path)
        path = std::make_shared<Path>(seed_ * 1000 + unsigned(paths_.size()) * 50);
    return path;
}

void Network::connect(const std::string& name, std::uint16_t port, Duration patience,
                      Connected done) {
    const auto path = this->path(name);
    // TCP, TLS and the WebSocket have these.
    const Duration handshakes = 6 * path->delay;
    schedule().after(handshakes, [this, path, port, name, patience, handshakes, done] {
        if (path->is_cut())
            return void(schedule().after(patience - handshakes,
                                         [done] { done(Fault::timeout, nullptr, ""); }));
        const auto found = listeners_.find(port);
        if (found == listeners_.end())
            return done(Fault::refused, nullptr, "");
        const Listener listener = found->second;
        const auto [theirs, ours] = Plug::connect(path);
        listener.accept(ours, name);
        done(Fault::none, theirs, listener.fingerprint());
    });
}

}  // namespace theatron::world
