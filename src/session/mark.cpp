// SPDX-License-Identifier: Apache-2.0
#include "session/mark.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/float_bytes.h"

namespace theatron::session {
namespace {

constexpr double normal_scale = 32767;

bool has_right_count(MarkKind kind, std::size_t points) {
    switch (kind) {
        case MarkKind::stroke:
            return points >= 2 && points <= most_mark_points;
        case MarkKind::pin:
            return points == 1;
        case MarkKind::arrow:
        case MarkKind::distance:
            return points == 2;
    }
    return false;
}

bool is_valid(const Mark& mark) {
    if (mark.kind < MarkKind::stroke || mark.kind > MarkKind::distance ||
        mark.surface < MarkedSurface::cloud || mark.surface > MarkedSurface::slice)
        return false;
    if ((mark.surface == MarkedSurface::cloud) != (mark.object == 0) ||
        (mark.kind == MarkKind::pin) != (mark.number > 0))
        return false;
    // Rejects NaN, too, and minus zero, which would be a second form of the same mark.
    const bool deviation_fits = mark.kind == MarkKind::distance
                                    ? mark.deviation_m >= 0 && mark.deviation_m <= 1000
                                    : mark.deviation_m == 0;
    return deviation_fits && !std::signbit(mark.deviation_m) &&
           mark.initials.size() <= most_initials_bytes &&
           has_right_count(mark.kind, mark.points.size()) &&
           std::all_of(mark.points.begin(), mark.points.end(), [](const MarkPoint& point) {
               const double n = length(point.normal);
               const Vec3 p = point.position;
               return n > 0.99 && n < 1.01 && std::abs(p.x) <= farthest_mark_point_m &&
                      std::abs(p.y) <= farthest_mark_point_m &&
                      std::abs(p.z) <= farthest_mark_point_m;
           });
}

// The length of the UTF-8 character that begins at `text`, which is not empty; bytes that begin
// none count as characters of their own.
std::size_t character_length(std::string_view text) {
    const auto first = std::uint8_t(text[0]);
    const std::size_t size = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    return std::min(size, text.size());
}

double distance_to_line(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double l = dot(along, along);
    const double t = l > 0 ? std::clamp(dot(p - a, along) / l, 0.0, 1.0) : 0;
    return length(p - a - along * t);
}

std::vector<MarkPoint> reduced(const std::vector<MarkPoint>& line, double tolerance_m) {
    std::vector<bool> kept(line.size(), false);
    kept.front() = kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        std::size_t farthest = first;
        double most = tolerance_m;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double d =
                distance_to_line(line[i].position, line[first].position, line[last].position);
            if (d > most) {
                most = d;
                farthest = i;
            }
        }
        if (farthest == first)
            continue;
        kept[farthest] = true;
        open.push_back({first, farthest});
        open.push_back({farthest, last});
    }
    std::vector<MarkPoint> result;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (kept[i])
            result.push_back(line[i]);
    return result;
}

}  // namespace

std::string_view to_text(MarkKind kind) {
    switch (kind) {
        case MarkKind::stroke:
            return "stroke";
        case MarkKind::arrow:
            return "arrow";
        case MarkKind::pin:
            return "pin";
        case MarkKind::distance:
            break;
    }
    return "distance";
}

std::string_view to_text(MarkedSurface surface) {
    return surface == MarkedSurface::cloud   ? "cloud"
           : surface == MarkedSurface::organ ? "organ"
                                             : "slice";
}

Bytes encode_mark(const Mark& mark) {
    Bytes out;
    ByteWriter writer(out);
    writer.put(std::uint8_t(mark.kind));
    writer.put(std::uint8_t(mark.surface));
    writer.put(mark.object);
    writer.put(mark.color);
    writer.put(mark.number);
    put_f32(writer, mark.deviation_m);
    writer.put(std::uint8_t(mark.initials.size()));
    writer.put_bytes(as_bytes(mark.initials));
    writer.put(std::uint8_t(mark.points.size()));
    for (const MarkPoint& point : mark.points) {
        const Vec3 p = point.position, n = point.normal;
        for (const double v : {p.x, p.y, p.z})
            put_f32(writer, float(v));
        for (const double v : {n.x, n.y, n.z})
            writer.put(std::int16_t(std::lround(v * normal_scale)));
    }
    return out;
}

std::optional<Mark> decode_mark(ByteView properties) {
    ByteReader reader(properties);
    Mark mark;
    mark.kind = MarkKind(reader.get<std::uint8_t>());
    mark.surface = MarkedSurface(reader.get<std::uint8_t>());
    mark.object = reader.get<std::uint32_t>();
    mark.color = reader.get<std::uint8_t>();
    mark.number = reader.get<std::uint16_t>();
    mark.deviation_m = get_f32(reader);
    const auto initials = reader.get<std::uint8_t>();
    for (int i = 0; i < initials && reader.ok(); ++i)
        mark.initials += char(reader.get<std::uint8_t>());
    const auto count = reader.get<std::uint8_t>();
    for (int i = 0; i < count && reader.ok(); ++i) {
        MarkPoint point;
        for (double* v : {&point.position.x, &point.position.y, &point.position.z})
            *v = double(get_f32(reader));
        for (double* v : {&point.normal.x, &point.normal.y, &point.normal.z})
            *v = reader.get<std::int16_t>() / normal_scale;
        mark.points.push_back(point);
    }
    if (!reader.ok() || !reader.rest().empty() || !is_valid(mark))
        return std::nullopt;
    return mark;
}

std::string initials_of(std::string_view name) {
    std::string first, last;
    bool at_start = true;
    while (!name.empty()) {
        const std::size_t size = character_length(name);
        if (at_start && name[0] != ' ') {
            last = name.substr(0, size);
            if (first.empty())
                first = std::exchange(last, "");
        }
        at_start = name[0] == ' ';
        name.remove_prefix(size);
    }
    return first.empty() ? "?" : first + last;
}

std::vector<MarkPoint> simplified(const std::vector<MarkPoint>& line, double tolerance_m,
                                  std::size_t most) {
    if (line.size() < 3)
        return line;
    tolerance_m = std::max(tolerance_m, 1e-6);
    std::vector<MarkPoint> result = reduced(line, tolerance_m);
    while (result.size() > most) {
        tolerance_m *= 2;
        result = reduced(line, tolerance_m);
    }
    return result;
}

}  // namespace theatron::session
