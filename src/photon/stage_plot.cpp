// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "photon/stages.h"
#include "photon/svg_text.h"

namespace theatron::photon {
namespace {

constexpr double plot_width = 760, bar_left = 16, bar_right = 744, bar_top = 40, bar_height = 44;
constexpr double lines_top = 116, line_height = 22;
// Neighbours differ in brightness, too, for people who do not see colours apart.
constexpr const char* stage_colors[] = {"#1f5fa8", "#8ec1e8", "#b35900", "#f2b36b",
                                        "#4a4a4a", "#b9b9b9", "#2e7d32", "#9bd19e"};
static_assert(std::size(stage_colors) == stage_count);

}  // namespace

std::string stages_svg(const std::vector<Stage>& stages, const std::string& title) {
    double sum = 0, drawn = 0;
    for (const Stage& stage : stages) {
        sum += stage.mean_ms;
        drawn += std::max(stage.mean_ms, 0.0);
    }
    const double height = lines_top + line_height * double(stages.size());
    std::string svg;
    svg_add(svg,
            "<svg xmlns='http://www.w3.org/2000/svg' width='%.0f' height='%.0f' "
            "viewBox='0 0 %.0f %.0f' font-family='sans-serif' font-size='12'>\n"
            "<rect width='%.0f' height='%.0f' fill='#ffffff'/>\n",
            plot_width, height, plot_width, height, plot_width, height);
    svg += "<text x='16' y='24' font-size='15'>" + svg_escaped(title) + "</text>\n";
    double x = bar_left, line = lines_top;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const char* const color = stage_colors[i % std::size(stage_colors)];
        const double width =
            drawn > 0 ? std::max(stages[i].mean_ms, 0.0) / drawn * (bar_right - bar_left) : 0;
        svg_add(svg,
                "<rect class='stage' x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s'/>\n", x,
                bar_top, width, bar_height, color);
        svg_add(svg, "<rect x='16' y='%.1f' width='12' height='12' fill='%s'/>\n", line - 10,
                color);
        svg_add(svg, "<text x='96' y='%.1f' text-anchor='end'>%.1f ms</text>\n", line,
                stages[i].mean_ms);
        svg_add(svg, "<text x='110' y='%.1f'>", line);
        svg += svg_escaped(stages[i].name) + "</text>\n";
        x += width;
        line += line_height;
    }
    svg_add(svg, "<text x='%.1f' y='%.1f' text-anchor='end'>%.1f ms in all</text>\n", bar_right,
            bar_top + bar_height + 16, sum);
    return svg + "</svg>\n";
}

}  // namespace theatron::photon
