// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "compare_page_parts.h"
#include "compare_words.h"
#include "render/gl_driver.h"
#include "svg_drawing.h"

namespace theatron::bench {
namespace {

// A figure and, below it, what it means.
struct Cell {
    std::string figure, words;
};

class Table {
public:
    explicit Table(const Compared& compared) {
        for (const CompareMethod& method : compared.methods)
            if (method.is_measured())
                methods_.push_back(&method);
        text_ = "<table role=\"table\" style=\"--methods: " + std::to_string(methods_.size()) +
                "\">\n<thead role=\"rowgroup\"><tr role=\"row\"><th role=\"columnheader\"></th>";
        for (const CompareMethod* method : methods_)
            text_ += "<th role=\"columnheader\" scope=\"col\"" + class_of(*method) + ">" +
                     escaped(method->name) + "</th>";
        text_ += "</tr></thead>\n<tbody role=\"rowgroup\">\n";
    }

    bool empty() const { return methods_.empty(); }

    void part(const std::string& title) {
        text_ +=
            "<tr class=\"part\" role=\"row\"><th role=\"rowheader\" scope=\"rowgroup\" colspan=\"" +
            std::to_string(methods_.size() + 1) + "\">" + escaped(title) + "</th></tr>\n";
    }

    void row(const std::string& title, const std::string& meaning,
             const std::function<Cell(const CompareMethod&)>& cell_of) {
        text_ += "<tr role=\"row\"><th role=\"rowheader\" scope=\"row\">" + escaped(title) +
                 small(meaning) + "</th>";
        for (const CompareMethod* method : methods_) {
            const Cell cell = cell_of(*method);
            text_ += "<td role=\"cell\"" + class_of(*method, cell.figure.empty()) + " data-way=\"" +
                     escaped(method->name) + "\">" + escaped(cell.figure) + small(cell.words) +
                     "</td>";
        }
        text_ += "</tr>\n";
    }

    std::string text() const { return text_ + "</tbody></table>\n"; }

private:
    // "none" has no line where the table is a list.
    static std::string class_of(const CompareMethod& method, bool has_no_figure = false) {
        const bool is_ours = method.id == theatron_id || method.id == theatron_near_id ||
                             method.id == theatron_and_call_id;
        if (!is_ours && !has_no_figure)
            return "";
        return std::string(" class=\"") + (is_ours ? "ours" : "") +
               (is_ours && has_no_figure ? " " : "") + (has_no_figure ? "none" : "") + "\"";
    }
    static std::string small(const std::string& words) {
        return words.empty() ? "" : "<small>" + escaped(words) + "</small>";
    }

    std::vector<const CompareMethod*> methods_;
    std::string text_;
};

const Cell no_such_picture = {"", "no such picture"}, not_its_own = {"", "no picture of its own"};

// No figure: a pair has the pictures of its two ways, a video call none from there.
Cell picture_of_others(const CompareMethod& method) {
    return method.is_pair ? not_its_own : no_such_picture;
}

Cell psnr_cell(double db) {
    return {tenths_text(db) + " dB", psnr_words(db)};
}

using Percent = double CompareLikeness::*;
using CausePercent = double CompareCauses::*;

Cell percent_cell(double percent) {
    return {tenths_text(percent) + " %", ""};
}

using SharePercent = double CompareShares::*;

// The rows of the wound, first: they decide.
void add_shares(Table& table, CompareShares CompareWound::*region) {
    const auto of = [=](SharePercent figure) {
        return [=](const CompareMethod& m) {
            return m.wound ? percent_cell((*m.wound).*region.*figure) : no_such_picture;
        };
    };
    table.row("Shown rightly",
              "the surface that is there, at most 2 cm off; of a video call: what its camera sees; "
              "higher is better",
              of(&CompareShares::rightly_percent));
    table.row("Shown wrongly", "something else in its place, without a mark; lower is better",
              of(&CompareShares::wrongly_percent));
    table.row("Not shown", "dark, or hidden from the camera; the three are 100 % together",
              of(&CompareShares::hidden_percent));
}

void add_wound(Table& table, const Compared& c) {
    table.part("The " + near_wound_text(c) +
               " around the wound: what an expert at the foot of the table should see of them");
    add_shares(table, &CompareWound::near);
    table.row("Detail", "of the wound in a pixel of the best camera that sees it; lower is better",
              [](const CompareMethod& m) {
                  return m.wound && m.wound->near.detail_mm > 0
                             ? Cell{tenths_text(m.wound->near.detail_mm) + " mm", ""}
                             : no_such_picture;
              });
    table.row("Shown rightly, at 1 mm a pixel or finer", "a part of the first row",
              [](const CompareMethod& m) {
                  return m.wound ? percent_cell(m.wound->near.finely_percent) : no_such_picture;
              });
    const auto cause = [](CausePercent figure) {
        return [=](const CompareMethod& m) {
            return m.wound && m.wound->lost ? percent_cell((*m.wound->lost).*figure)
                                            : picture_of_others(m);
        };
    };
    table.row("Lost because no camera sees the place",
              "the four causes together are what is shown wrongly or not at all",
              cause(&CompareCauses::no_camera));
    table.row("because the sensor measures nothing there", "although its camera sees the place",
              cause(&CompareCauses::sensor));
    table.row("because filters drop it", "", cause(&CompareCauses::filters));
    table.row("because drawing loses or moves it", "although it arrived",
              cause(&CompareCauses::drawing));
}

void add_close_up(Table& table, double width_m) {
    const auto of = [](Percent figure) {
        return [=](const CompareMethod& m) {
            return m.close_up && m.close_up->likeness
                       ? percent_cell((*m.close_up->likeness).*figure)
                       : picture_of_others(m);
        };
    };
    table.part("The " + whole_text(width_m * 100) + " cm around the wound, from there");
    add_shares(table, &CompareWound::whole);
    table.row("Seen through",
              "of what is drawn: a surface is missing, and something more than 15 cm behind shows",
              of(&CompareLikeness::see_through_percent));
    table.row(
        "Instruments missing",
        "of the surface of instruments: nothing, or something more than 2 cm behind, is drawn",
        [](const CompareMethod& m) {
            return m.close_up && m.close_up->instruments
                       ? percent_cell(m.close_up->instruments->sum())
                       : picture_of_others(m);
        });
    table.row("Likeness",
              "against the exact picture, where a camera sees the surface; higher is "
              "better",
              [](const CompareMethod& m) {
                  return m.close_up && m.close_up->likeness
                             ? psnr_cell(m.close_up->likeness->psnr_db)
                             : picture_of_others(m);
              });
}

std::string places_title(std::size_t count) {
    return count == 1 ? "From the expert's standing place"
                      : "Mean of the expert's " + std::to_string(count) +
                            " standing places, without the close-up";
}

void add_pictures(Table& table, std::size_t places) {
    const auto percent = [](Percent figure) {
        return [=](const CompareMethod& m) {
            return m.expert ? percent_cell((*m.expert).*figure) : picture_of_others(m);
        };
    };
    table.part(places_title(places));
    table.row("Looks from any place", "or only from where a camera hangs",
              [](const CompareMethod& m) {
                  return Cell{m.is_video ? "no" : "yes", ""};
              });
    table.row("Dark part of the picture", "of the whole picture; lower is better",
              percent(&CompareLikeness::undrawn_percent));
    table.row("Dark because no camera sees it",
              "a part of the figure above, of the whole picture, too; decided by how many cameras "
              "there are and where they hang",
              percent(&CompareLikeness::undrawn_unseen_percent));
    table.row("Seen through",
              "of what is drawn: a surface is missing, and something behind it shows; lower is "
              "better",
              percent(&CompareLikeness::see_through_percent));
    table.row("Missing although a camera sees it",
              "of the surfaces that a camera sees, without their edges: lost by sensor or method; "
              "lower is better",
              percent(&CompareLikeness::holes_percent));
    table.row("Likeness from the expert's place",
              "against the exact picture, where a camera sees the surface; missing parts count; "
              "higher is better",
              [](const CompareMethod& m) {
                  return m.expert ? psnr_cell(m.expert->psnr_db) : picture_of_others(m);
              });
    table.row("Likeness of shapes from there", "higher is better, 1 is equal",
              [](const CompareMethod& m) {
                  return m.expert
                             ? Cell{formatted("%.3f", m.expert->ssim), ssim_words(m.expert->ssim)}
                             : picture_of_others(m);
              });
    table.row("Likeness of the camera's own picture", "what a video call is good at",
              [](const CompareMethod& m) {
                  return m.own_view  ? psnr_cell(m.own_view->psnr_db)
                         : m.is_pair ? picture_of_others(m)
                                     : Cell{"", "sends none"};
              });
}

const Cell two_kinds = {"", "two kinds of camera"};

void add_costs(Table& table, const Compared& c) {
    table.part("What it costs");
    table.row("Cameras", "", [](const CompareMethod& m) {
        return Cell{std::to_string(m.cameras), ""};
    });
    table.row("Data for the whole view", "all cameras together, at 30 pictures a second",
              [](const CompareMethod& m) {
                  return Cell{tenths_text(m.mbit_of_all()) + " Mbit/s",
                              m.id == paper_id ? paper_caveat() : ""};
              });
    table.row("Data of one camera", "", [](const CompareMethod& m) {
        if (m.is_pair)
            return two_kinds;
        return Cell{tenths_text(m.mbit_per_camera) + " Mbit/s",
                    m.rate_setting_mbit > 0
                        ? "set to " + formatted("%g", m.rate_setting_mbit) +
                              " Mbit/s; these pictures needed " +
                              (m.mbit_per_camera < m.rate_setting_mbit ? "less" : "more")
                        : ""};
    });
    table.row("Work in the operating room",
              "of one processor core, for a picture of all cameras; 33 ms are all of a core",
              [](const CompareMethod& m) {
                  return Cell{tenths_text(m.sender_of_all_ms) + " ms", ""};
              });
    table.row("for a picture of one camera", "", [](const CompareMethod& m) {
        return m.is_pair ? two_kinds : Cell{tenths_text(m.sender_ms) + " ms", ""};
    });
    table.row("Work at the expert's", "for a picture of all cameras, without drawing",
              [](const CompareMethod& m) {
                  return Cell{tenths_text(m.receiver_of_all_ms) + " ms", ""};
              });
    table.row("Drawing at the expert's",
              c.gl_renderer.empty()
                  ? "of a picture of all cameras, on the clock"
                  : "of a picture of all cameras, on the clock, by " + c.gl_renderer +
                        (render::is_software(c.gl_renderer)
                             ? ", which is the processor; a graphics card is many times quicker"
                             : ""),
              [&](const CompareMethod& m) {
                  if (m.drawn_on.empty())
                      return Cell{"", "not measured"};
                  return Cell{tenths_text(m.drawing_ms) + " ms",
                              m.drawn_on == c.gl_renderer ? "" : "by " + m.drawn_on};
              });
}

}  // namespace

const char* paper_caveat() {
    return "its depth is sent without loss here; the study's own loses detail for fewer bytes";
}

std::string compare_table(const Compared& c) {
    Table table(c);
    if (table.empty())
        return "";
    add_wound(table, c);
    add_close_up(table, c.close_up_width_m);
    add_pictures(table, c.places.size());
    add_costs(table, c);
    for (std::size_t i = 0; i < c.links.size(); ++i) {
        table.part("Over " + line_text(c.links[i]) + " with " + whole_text(c.links[i].latency_ms) +
                   " ms of delay each way");
        table.row("Pictures a second", "of all cameras, at most 30", [i](const CompareMethod& m) {
            return Cell{tenths_text(m.links[i].pictures_per_s), ""};
        });
        table.row("Age on arrival", "mean, and what 95 of 100 pictures stay below",
                  [i](const CompareMethod& m) {
                      return Cell{whole_text(m.links[i].delay_ms) + " ms",
                                  "95 of 100: " + whole_text(m.links[i].delay_p95_ms) + " ms"};
                  });
    }
    return "<h2>What it gives and what it costs</h2>\n"
           "<p class=\"quiet list\">A way without such a picture has no line.</p>\n" +
           table.text() + "<p class=\"quiet\">" + escaped(psnr_scale()) + " " +
           escaped(ssim_scale()) + " The words are this page's own, not a standard's.</p>\n";
}

}  // namespace theatron::bench
