// SPDX-License-Identifier: Apache-2.0
// Marks of each kind, for tests.
#pragma once

#include <vector>

#include "session/mark.h"

namespace theatron::session {

inline Mark stroke(std::size_t points) {
    Mark mark;
    mark.surface = MarkedSurface::organ;
    mark.object = 0x01020304;
    mark.color = 5;
    mark.initials = "\u00d6K";
    for (std::size_t i = 0; i < points; ++i)
        mark.points.push_back({{0.5 * double(i), -0.25, 2}, {0, i % 2 ? -1.0 : 1.0, 0}});
    return mark;
}

inline Mark pin() {
    Mark mark;
    mark.kind = MarkKind::pin;
    mark.number = 12;
    mark.initials = "AB";
    mark.points = {{{1, 2, 3}, {0, 0, 1}}};
    return mark;
}

inline Mark between(MarkKind kind, Vec3 a, Vec3 b) {
    Mark mark;
    mark.kind = kind;
    mark.initials = "AB";
    mark.points = {{a, {0, 1, 0}}, {b, {0, 1, 0}}};
    return mark;
}

inline std::vector<Mark> examples() {
    Mark distance = between(MarkKind::distance, {0, 1, 0}, {0, 1, 0.25});
    distance.deviation_m = 0.0015f;
    return {stroke(2), stroke(most_mark_points), pin(), distance,
            between(MarkKind::arrow, {0, 1, 0}, {0.5, 1, 0})};
}

}  // namespace theatron::session
