// SPDX-License-Identifier: Apache-2.0
#include "session/mark.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <utility>

#include "base/float_bytes.h"

namespace theatron::session {
namespace {

constexpr double normal_scale = 32767;

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// "Dr.", "Prof", "Dipl.-Ing.", "med.": an abbreviation of more than one letter, unlike "J.R.".
bool is_title(std::string_view word) {
    constexpr std::string_view whole[] = {"Dr", "Prof", "Professor", "Doctor", "PD",
                                          "Mr", "Mrs",  "Ms",        "Herr",   "Frau"};
    if (std::find(std::begin(whole), std::end(whole), word) != std::end(whole))
        return true;
    if (word.empty() || word.back() != '.')
        return false;
    return std::adjacent_find(word.begin(), word.end(), [](char a, char b) {
               return is_letter(a) && is_letter(b);
           }) != word.end();
}

// The name from its first word that is no title; the last word stays in any case.
std::string_view without_titles(std::string_view name) {
    const auto begin_at = [&](std::size_t at) {
        name.remove_prefix(std::min(name.find_first_not_of(' ', at), name.size()));
    };
    begin_at(0);
    for (std::size_t end = name.find(' '); end != name.npos; end = name.find(' ')) {
        if (name.find_first_not_of(' ', end) == name.npos || !is_title(name.substr(0, end)))
            break;
        begin_at(end);
    }
    return name;
}

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

// The points between two kept ones, and the one of them that is farthest from the line between.
struct Span {
    std::size_t begin = 0, end = 0, farthest = 0;
    double deviation_m = 0;
    bool operator<(const Span& other) const { return deviation_m < other.deviation_m; }
};
Span span_of(const std::vector<MarkPoint>& line, std::size_t begin, std::size_t end) {
    Span span{begin, end};
    for (std::size_t i = begin + 1; i < end; ++i) {
        const double deviation_m =
            distance_to_line(line[i].position, line[begin].position, line[end].position);
        if (deviation_m > span.deviation_m) {
            span.deviation_m = deviation_m;
            span.farthest = i;
        }
    }
    return span;
}

std::string first_letters(std::string_view name) {
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
    return first_letters(without_titles(name));
}

bool may_be_initials_of(std::string_view name, std::string_view initials) {
    return initials == initials_of(name) || initials == first_letters(name);
}

std::vector<MarkPoint> simplified(const std::vector<MarkPoint>& line, double tolerance_m,
                                  std::size_t most) {
    if (line.size() < 3)
        return line;
    std::set<std::size_t> kept{0, line.size() - 1};
    std::priority_queue<Span> spans;
    spans.push(span_of(line, 0, line.size() - 1));
    while (kept.size() < most && spans.top().deviation_m > std::max(tolerance_m, 1e-6)) {
        const Span worst = spans.top();
        spans.pop();
        kept.insert(worst.farthest);
        spans.push(span_of(line, worst.begin, worst.farthest));
        spans.push(span_of(line, worst.farthest, worst.end));
    }
    std::vector<MarkPoint> result;
    for (const std::size_t i : kept)
        result.push_back(line[i]);
    return result;
}

}  // namespace theatron::session
