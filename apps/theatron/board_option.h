// SPDX-License-Identifier: Apache-2.0
// --board and --thickness, the same in every command.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "cli/number_check.h"
#include "registration/lattice_target.h"

namespace theatron::app {

struct BoardFlags {
    std::string board = "80x60";
    double thickness_mm = 0;  // 0: the board's usual one
};

inline void add_board_options(CLI::App& command, BoardFlags& flags) {
    command
        .add_option("--board", flags.board,
                    "The board: 80x60 (centimetres), a2, or another size as WIDTHxHEIGHT:BAR, the "
                    "last for the width of its bars, for example 79.2x59.4:5.9")
        ->capture_default_str();
    command
        .add_option("--thickness", flags.thickness_mm,
                    "How thick the board is, millimetres (10 and 5 unless it is given)")
        ->check(cli::number_check([](double mm) { return mm >= 0.5 && mm <= 40; },
                                  "is not a thickness from 0.5 to 40 millimetres"));
}

// A board by its name, or as WIDTHxHEIGHT:BAR in centimetres; empty: there is none.
inline std::optional<registration::LatticeTarget> find_board(const std::string& text) {
    if (text == "80x60")
        return registration::large_target();
    if (text == "a2")
        return registration::a2_target();
    constexpr double largest_cm = 300;
    registration::LatticeTarget target;
    const char* next = text.data();
    const char* const end = next + text.size();
    const std::pair<double*, const char*> parts[] = {
        {&target.width_m, "x"}, {&target.height_m, ":"}, {&target.bar_m, ""}};
    for (const auto& [size_m, after] : parts) {
        double cm = 0;
        const auto [past, error] = std::from_chars(next, end, cm);
        if (error != std::errc() || !(cm > 0 && cm <= largest_cm) ||
            (*after ? past == end || *past != *after : past != end))
            return {};
        *size_m = cm / 100;
        next = past + (*after ? 1 : 0);
    }
    return target;
}

// Throws Error where there is no such board.
inline registration::LatticeTarget board_of(const BoardFlags& flags) {
    auto target = find_board(flags.board);
    if (target && flags.thickness_mm > 0)
        target->thickness_m = flags.thickness_mm / 1000;
    if (!target || !registration::is_valid(*target) || target->width_m < target->height_m)
        throw Error("There is no board '" + flags.board +
                    "'; there are 80x60, a2, and others as WIDTHxHEIGHT:BAR in centimetres, at "
                    "most 300, the longer side first, with holes of 2 cm or more between bars that "
                    "are wider than the board is thick.");
    return *target;
}

}  // namespace theatron::app
