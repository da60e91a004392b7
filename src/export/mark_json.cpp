// SPDX-License-Identifier: Apache-2.0
#include "export/mark_json.h"

namespace theatron::exporting {

nlohmann::json mark_json(const session::Mark& mark) {
    nlohmann::json points = nlohmann::json::array();
    for (const session::MarkPoint& point : mark.points)
        points.push_back({point.position.x, point.position.y, point.position.z});
    nlohmann::json json{{"kind", session::to_text(mark.kind)},
                        {"surface", session::to_text(mark.surface)},
                        {"initials", mark.initials},
                        {"points", std::move(points)}};
    if (mark.object != 0)
        json["object"] = mark.object;
    if (mark.kind == session::MarkKind::pin)
        json["number"] = mark.number;
    if (mark.kind == session::MarkKind::distance) {
        json["length_m"] = length(mark.points[1].position - mark.points[0].position);
        if (mark.deviation_m > 0)
            json["deviation_m"] = mark.deviation_m;
    }
    return json;
}

}  // namespace theatron::exporting
