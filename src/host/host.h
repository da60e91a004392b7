// SPDX-License-Identifier: Apache-2.0
// A running session of a host: cameras, their lanes, the session, and its network port, which other
// sessions of this host may share.
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
#include "host/port_options.h"
#include "host/session_options.h"
#include "net/link.h"
#include "send/camera_lane.h"
#include "session/camera_adjustment.h"

namespace theatron::host {

// The options of the first session of a host, and of the port that all its sessions share.
struct HostOptions : SessionOptions, PortOptions {};

// Runs from construction to destruction, on its own threads. Functions: any thread, unless stated.
class Host {
public:
    // Opens cameras and port. Throws Error with one sentence if one of them cannot be opened.
    Host(const HostOptions& options, const capture::Progress& progress);
    // A further session on the port of `first`, which must outlive it. Its state folder is one of
    // its own. Throws Error as above.
    Host(const SessionOptions& options, const Host& first, const capture::Progress& progress);
    ~Host();

    // Other sessions on this port that are not open now, instead of those before.
    void set_closed(std::vector<ClosedSession> closed);
    // When it ends, the audit log and its participants are told that it was ended for good, the log
    // also that this was done at the host. To be called by the thread that destroys it.
    void end_by_host();
    // When it ends, its participants are told that its program may be started again; those with a
    // link then wait for it. Without this the session is over for them. As above.
    void end_for_now();
    // The audit log says that this further session was deleted.
    void note_deleted(const std::string& session);

    // The link of a role, which stays valid, except that it changes with the certificate.
    std::string link(wire::Role role = wire::Role::expert) const;
    std::uint16_t port() const;
    std::vector<std::string> camera_names() const;
    // The cameras without a known place in the room, which are placed side by side, 12 m apart;
    // screens are none of them.
    std::vector<std::string> unregistered_cameras() const;

    // The part of a camera's depth image, in its pixels, that stays exact on any link,
    // from the next frame on; empty: all of it. Throws Error with one sentence if it has
    // too many parts or lies outside the image.
    void set_region(std::size_t camera, codec::strata::Region region);

    // Adjusts a camera of the host for all, as an operator does. A refusal is printed.
    void adjust(std::size_t camera, const session::CameraAdjustment& adjustment);
    // The sum over all cameras of the host.
    std::vector<session::CameraAdjustment> adjustments() const;

    // Plays the recording that the cameras show, as a participant does. A refusal is printed.
    void play(wire::PlayAction action, Duration position = {});
    // Where it is; empty: no camera plays one.
    std::optional<wire::Playback> playback() const;

    // Sets the renderer of a participant, by number or name, or of all (empty). Throws Error with
    // one sentence if there is no such participant.
    void set_renderer(const std::string& who, const wire::SetRenderer& word);

    // Loads changed filter files again, and logs it. From one thread.
    void follow_filter_files();
    // The same for links that were made or revoked (host/link_book.h).
    void follow_links();

    // The same for certificates. Their problems are also logged, and part of the figures.
    void follow_certificates();

    // Carries out a decision of the person at this machine, as one of an operator. A refusal is
    // printed.
    void manage(wire::ManageAction action, ParticipantId person = {}, wire::Role role = {});

    // Figures since the start: cameras with stages, participants, drops.
    HostFigures figures() const;
    // One line of the same for people.
    std::string status_line() const;
    std::size_t participants() const { return participants_; }
    // Why the room could not be saved; empty if it was.
    std::string room_problem() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    std::atomic<std::size_t> participants_{0};
};

}  // namespace theatron::host
