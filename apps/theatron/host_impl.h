// SPDX-License-Identifier: Apache-2.0
// The inside of a Host: what its threads share.
#pragma once

#include <map>
#include <mutex>
#include <set>

#include "base/steady_clock.h"
#include "filter_choice.h"
#include "host.h"
#include "net/certificate.h"
#include "net/server.h"
#include "session/host_session.h"

namespace theatron::app {

struct Host::Impl {
    std::atomic<std::size_t>& participants;
    net::Certificate certificate;
    net::Link link;
    std::unique_ptr<session::HostSession> session;
    std::unique_ptr<net::Server> server;
    send::Workers workers;
    std::vector<std::unique_ptr<send::CameraLane>> lanes;
    std::vector<FilterSource> filters;  // by camera; used by who owns the host
    std::thread thread;
    // Which cameras have a region of interest; server's thread.
    std::set<std::size_t> with_region;
    std::set<std::size_t> held;  // lanes; server's thread
    // Frames given up per camera because a receiver was too slow; server's thread.
    std::map<CameraId, std::uint64_t> dropped_slow;
    mutable std::mutex figures_mutex;
    std::vector<HostFigures::Participant> participant_figures;
    std::map<CameraId, std::uint64_t> dropped_slow_figures;
    std::string name;
    std::vector<std::string> http_tokens;
    const TimePoint begun = steady_now();

    explicit Impl(std::atomic<std::size_t>& count) : participants(count) {}
    ~Impl() {
        // The server's thread uses the lanes: it ends first.
        if (server)
            server->stop();
        if (thread.joinable())
            thread.join();
        lanes.clear();
    }

    void open(const HostOptions& options, const capture::Progress& progress);
    wire::Camera describe(CameraId id, const capture::CameraInfo& info) const;
    net::Server::Handler handler();
    void start_lanes(const std::vector<std::string>& specifications,
                     std::vector<std::unique_ptr<capture::Camera>> cameras);

    // All below on the server's thread.
    void carry_out();
    void change_settings();
    void hold_lane(std::size_t camera);
    void hold_lanes();
    void release_lanes();
    void distribute(const send::EncodedMedia& media);
    void measure_links();
    void note_participants();

    // From any thread.
    HostFigures figures() const;
};

}  // namespace theatron::app
