// SPDX-License-Identifier: Apache-2.0
// A running host: cameras, their lanes, the session and its network port.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/time.h"
#include "codec/strata_region.h"
#include "host/host_figures.h"
#include "net/link.h"
#include "send/camera_lane.h"

namespace theatron::host {

struct HostOptions {
    std::vector<std::string> cameras;  // specifications
    std::filesystem::path places;      // docs/formats/places.md; empty: none
    std::vector<std::string> filters;  // filter_choice.h
    net::Endpoint listen;
    std::string name = "operating room";
    std::string link_host;        // what the link says; empty: found out
    std::string token;            // empty: kept in the state folder
    Duration link_lifetime{};     // the links let nobody in after it; 0: they always do
    std::filesystem::path state;  // keys and token; empty: the user's state folder
};

// Works from construction to destruction, on threads of its own.
class Host {
public:
    // Opens everything; throws Error with one sentence if something cannot be had.
    Host(const HostOptions& options, const capture::Progress& progress);
    ~Host();

    std::string link() const;
    // The same for participants who may send cameras, too.
    std::string publish_link() const;
    std::uint16_t port() const;
    std::vector<std::string> camera_names() const;
    // Those whose place in the room nobody knows. They stand side by side, 12 m apart.
    std::vector<std::string> unregistered_cameras() const;

    // The part of a camera's depth image, in its pixels, that stays exact whatever the
    // links carry, from the next frame on; empty: all of it. From any thread. Throws
    // Error with one sentence if it has too many parts or lies outside the image.
    void set_region(std::size_t camera, codec::strata::Region region);

    // How a participant should draw, by number or name, or all of them (empty). Throws Error with
    // one sentence if nobody is meant.
    void set_renderer(const std::string& who, const wire::SetRenderer& word);

    // Takes over filter files that were changed. Log lines tell.
    void follow_filter_files();

    // What went on so far: cameras with stages, participants, drops.
    HostFigures figures() const;
    // One line of the same for people.
    std::string status_line() const;
    std::size_t participants() const { return participants_; }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    std::atomic<std::size_t> participants_{0};
};

}  // namespace theatron::host
