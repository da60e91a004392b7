// SPDX-License-Identifier: Apache-2.0
// What goes on in a host, for people, scripts and monitoring (docs/metrics.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/ids.h"
#include "send/lane_figures.h"
#include "wire/control.h"

namespace theatron::host {

struct HostFigures {
    std::string name;
    double seconds = 0;  // since the host began
    struct Camera {
        send::LaneFigures lane;
        std::uint64_t dropped_slow = 0;  // given up because a receiver was too slow
    };
    std::vector<Camera> cameras;
    struct Participant {
        ParticipantId id{};
        std::string name;
        std::string sent;                         // how much of what it asked for
        std::vector<wire::StreamReport> streams;  // its newest report
        std::string renderer;                     // how it draws; empty: unknown
    };
    std::vector<Participant> participants;
};

// {"name","seconds","cameras":[{"name","state","problem","fps","age_ms","stages":[…],
// "dropped":{…},…}],"participants":[{"id","name","age_ms",
// "renderer",…}]}
nlohmann::json to_json(const HostFigures& figures);

// The text format of Prometheus, version 0.0.4.
std::string to_prometheus(const HostFigures& figures);

// A table of what to_json() gave, perhaps on another machine; fields may be missing.
std::string to_table(const nlohmann::json& figures);

}  // namespace theatron::host
