// SPDX-License-Identifier: Apache-2.0
#include "bench_plot.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "svg_drawing.h"

namespace theatron::bench {
namespace {

constexpr double panel_width = 560, panel_height = 420;
constexpr double left = 62, right = 24, top = 44, bottom = 52;
constexpr double letter_width = 6.3, line_height = 12;

struct Box {
    double x, y, width, height;
    bool overlaps(const Box& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
               other.y < y + height;
    }
};

void draw_panel(SvgDrawing& out, const nlohmann::json& sequence) {
    std::vector<double> ms, kb;
    for (const auto& codec : sequence["codecs"]) {
        // Times below the clock's resolution are drawn at the edge.
        ms.push_back(std::max(codec["encode_ms"].get<double>(), 0.005));
        ms.push_back(std::max(codec["decode_ms"].get<double>(), 0.005));
        kb.push_back(codec["bytes_mean"].get<double>() / 1000);
    }
    const LogAxis x = axis_of(ms, left, panel_width - right);
    const LogAxis y = axis_of(kb, panel_height - bottom, top);

    for (const double tick : x.ticks()) {
        out.line(x.place(tick), top, x.place(tick), panel_height - bottom, "#e3e3e3", 1);
        out.text(x.place(tick), panel_height - bottom + 16, formatted("%g", tick), "middle");
    }
    for (const double tick : y.ticks()) {
        out.line(x.from, y.place(tick), x.to, y.place(tick), "#e3e3e3", 1);
        out.text(x.from - 6, y.place(tick) + 4, formatted("%g", tick), "end");
    }
    out.text(left, 20,
             sequence["sequence"].get<std::string>() + ", " +
                 std::to_string(sequence["frames"].get<int>()) + " frames",
             "start", "font-weight='bold'");
    out.text((x.from + x.to) / 2, panel_height - 16, "ms a frame, one thread", "middle");
    out.text(left, 36, "kB a frame; filled: encode, hollow: decode, orange: lossy", "start",
             "fill='#555555'");

    std::vector<Box> taken;
    for (std::size_t i = 0; i < kb.size(); ++i)
        for (const double value : {ms[2 * i], ms[2 * i + 1]})
            taken.push_back({x.place(value) - 5, y.place(kb[i]) - 5, 10, 10});
    for (std::size_t i = 0; i < kb.size(); ++i) {
        const auto& codec = sequence["codecs"][i];
        const char* color = codec["lossless"].get<bool>() ? "#1f5fa8" : "#d4700f";
        const double encode = x.place(ms[2 * i]), decode = x.place(ms[2 * i + 1]);
        const double height = y.place(kb[i]);
        out.line(encode, height, decode, height, color, 0.8);
        out.circle(decode, height, color, false);
        out.circle(encode, height, color, true);

        // The label goes to the first free position beside the marks.
        const std::string name = codec["name"];
        const double width = letter_width * double(name.size());
        const double rightmost = std::max(encode, decode), leftmost = std::min(encode, decode);
        Box best{};
        bool found = false;
        for (int step = 0; step < 24 && !found; ++step) {
            const double shift = (step % 2 ? 1 : -1) * double((step + 1) / 2) * 6;
            for (const double begin : {rightmost + 8, leftmost - 8 - width}) {
                const Box box{begin, height + shift - line_height / 2, width, line_height};
                if (box.x < x.from || box.x + width > x.to + right - 2 || found)
                    continue;
                found = std::none_of(taken.begin(), taken.end(),
                                     [&](const Box& other) { return box.overlaps(other); });
                best = box;
            }
        }
        taken.push_back(best);
        out.text(best.x, best.y + line_height - 2.5, name, "start");
    }
}

}  // namespace

std::string size_speed_svg(const nlohmann::json& sequences) {
    constexpr std::size_t most_in_a_row = 3;
    const std::size_t columns = std::min(sequences.size(), most_in_a_row);
    const std::size_t rows = (sequences.size() + most_in_a_row - 1) / most_in_a_row;
    const double width = panel_width * double(columns), height = panel_height * double(rows);
    SvgDrawing drawing;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
        drawing.begin_at(panel_width * double(i % most_in_a_row),
                         panel_height * double(i / most_in_a_row));
        draw_panel(drawing, sequences[i]);
        drawing.end();
    }
    return drawing.document(width, height);
}

}  // namespace theatron::bench
