// SPDX-License-Identifier: Apache-2.0
// --board and --thickness, the same in every command.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/error.h"
#include "cli/number_check.h"
#include "registration/lattice_target.h"

namespace theatron::app {

struct BoardFlags {
    std::string board = "80x60";
    double thickness_mm = 0;  // 0: the board's usual one
};

inline void add_board_options(CLI::App& command, BoardFlags& flags) {
    command.add_option("--board", flags.board, "The board: 80x60 (centimetres) or a2")
        ->capture_default_str();
    command
        .add_option("--thickness", flags.thickness_mm,
                    "How thick the board is, millimetres (10 and 5 unless it is given)")
        ->check(cli::number_check([](double mm) { return mm >= 0.5 && mm <= 40; },
                                  "is not a thickness from 0.5 to 40 millimetres"));
}

// Throws Error where there is no such board.
inline registration::LatticeTarget board_of(const BoardFlags& flags) {
    if (flags.board != "80x60" && flags.board != "a2")
        throw Error("There is no board '" + flags.board + "'; there are 80x60 and a2.");
    registration::LatticeTarget target =
        flags.board == "a2" ? registration::a2_target() : registration::large_target();
    if (flags.thickness_mm > 0)
        target.thickness_m = flags.thickness_mm / 1000;
    return target;
}

}  // namespace theatron::app
