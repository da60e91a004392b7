// SPDX-License-Identifier: Apache-2.0
// Figures of a running host, for people, scripts and monitoring (docs/metrics.md).
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/moment_meter.h"
#include "base/time.h"
#include "base/utc.h"
#include "files/utc_text.h"
#include "host/closed_session.h"
#include "host/gain_watch.h"
#include "host/place_watch.h"
#include "send/lane_figures.h"
#include "wire/control.h"

namespace theatron::host {

struct HostFigures {
    std::string name;
    double seconds = 0;           // since the host began
    TimePoint session_time;       // now
    UtcTime utc;                  // now
    std::string automatic_color;  // its current choice, and why
    struct Camera {
        send::LaneFigures lane;
        std::uint64_t dropped_slow = 0;  // dropped because a receiver was too slow
    };
    std::vector<Camera> cameras;
    struct Participant {
        ParticipantId id{};
        std::string name;
        std::string sent;                         // the part of its request that it gets
        std::vector<wire::StreamReport> streams;  // its newest report
        std::string renderer;                     // as it reports it; empty: unknown
        std::uint64_t refused = 0;                // requests that came too often
        std::uint64_t denied = 0;                 // messages that its role does not allow
        std::uint64_t refused_pictures = 0;       // of its face or screen, beyond their limits
        wire::Role role{};
        bool muted = false;
        std::string link = {};  // the name of the link by which it came
        bool hand_raised = false;
        std::optional<ParticipantId> relay = {};  // that it was named
        std::set<CameraId> relayed = {};          // whose pictures come from it
    };
    std::vector<Participant> participants;
    struct Published {
        CameraId id{};
        std::string name;
        ParticipantId publisher{};
        wire::CameraCondition condition{};
        std::uint64_t dropped_slow = 0;  // as above
        bool is_face = false;            // of its publisher
        std::uint64_t bytes = 0;         // of pictures that the host has received
        // As those of LaneFigures; of the newest picture that came by the host, if any.
        std::optional<double> sync_offset_seconds = {};
        std::string filter = {}, filter_device = {};
    };
    std::vector<Published> published;  // cameras that participants send now
    MomentFigures moments;  // of the host's cameras, and of published ones as they come by it
    std::map<CameraId, std::string> adjusted;  // by operators, and how
    PlaceWatch::Figures places;                // whether cameras stay where they were registered
    // The origin of the cameras' places.
    struct Registration {
        std::string made, method;  // as its file says; empty: there is none
        std::string problem;       // host/mixed_registrations.h
    };
    Registration registration;
    GainWatch::Gains gains;                  // of colours, by camera
    bool has_ended = false;                  // the session
    std::vector<wire::Visitor> visitors;     // who wait for admission
    std::vector<std::string> case_problems;  // sentences on the folder of cases
    std::size_t past_bytes = 0;              // encoded pictures that are kept for looking back
    std::uint64_t turned_away = 0;           // strangers, since the host began
    bool offers_bbr = false;                 // the kernel (net/congestion_control.h)
    std::string page_problem;                // of the browser client (host/page.h); else empty
    std::uint64_t faults = 0;  // that cost a connection, a picture or a camera (base/fault.h)

    // Sentences about what the host cannot write or read, and operators must know; empty: all is
    // well.
    struct Problems {
        std::string audit_log, room, links;
    };
    Problems problems;

    struct Certificate {
        std::string of;  // "host" or "proxy"
        std::string fingerprint;
        files::UtcSeconds ends = 0;
        std::string problem;  // a sentence; empty: all is well
    };
    std::vector<Certificate> certificates;

    // Empty: the camera is as registered.
    std::string adjustment(CameraId camera) const {
        const auto found = adjusted.find(camera);
        return found == adjusted.end() ? "" : found->second;
    }
};

// Those of all sessions of a host that a reader may see.
struct PortFigures {
    std::vector<HostFigures> sessions;  // that are open, the first one first; not empty
    std::vector<ClosedSession> closed;
};

// {"name","utc","session_us","seconds","automatic_color","cameras":[{"name","state","problem","adjusted",
// "color_gain":{"red","green","blue","estimated"},
// "fps","age_ms","stages":[…],"dropped":{…},"lost_pictures",…}],"participants":[{"id","name","age_ms",
// "renderer","refused_requests","denied_messages","refused_pictures","role","muted","relay","relayed",…}],"visitors":[{"id","name",
// "person","role","records"}],"published":[{"id","name","publisher","whose","state",
// "adjusted","dropped_slow","bytes",
// "sync_offset_ms","filter","filter_device"}],"skew_ms":{"p50","max"},"unpaired","overlaps":[{"a","b","apart_mm","alarm"}],
// "registration":{"made","method","problem"},"case_problems":[…],"past_bytes","turned_away",
// "offers_bbr","faults","page_problem","problems":{"audit_log","room","links"},
// "certificates":[{"of","fingerprint","expires","seconds_left","problem"}]}
nlohmann::json to_json(const HostFigures& figures);
// One of its visitors; who has no name there has none here.
nlohmann::json visitor_json(const wire::Visitor& visitor);
// {"p50","max"}; null where no two cameras can be compared.
nlohmann::json skew_json(const MomentFigures& moments);
// The same of the first session of a host; those of its further ones are in "sessions", and those
// that are not open in "closed_sessions":[{"name","problem"}]. Both are missing where there are
// none.
nlohmann::json to_json(const PortFigures& all);

// The text format of Prometheus, version 0.0.4. Lines about a session other than the first have its
// name in the label `session`.
std::string to_prometheus(const PortFigures& all);

// A table of the output of to_json(), perhaps of another version; fields may be missing.
std::string to_table(const nlohmann::json& figures);

}  // namespace theatron::host
