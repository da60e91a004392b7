// SPDX-License-Identifier: Apache-2.0
// Training of the network, and figures of how well it tells emotions. Seconds on one core; the same
// network for the same input and seed.
#pragma once

#include <functional>
#include <optional>

#include "face/network.h"

namespace theatron::face {

struct TrainingParams {
    std::uint64_t seed = 1;
    int persons = 160;  // synthetic ones
    int epochs = 14;
    int own_epochs = 8;  // further ones, with the user's own takes
};

// Rows: asked for; columns: told. Counts of windows.
struct Confusion {
    std::array<std::array<int, emotion_count>, emotion_count> counts{};

    void add(Emotion asked, Emotion told) { ++counts[std::size_t(asked)][std::size_t(told)]; }
    int total() const;
    double accuracy() const;  // 0 without windows
};
// A table with the recall of each emotion, lines ended.
std::string to_text(const Confusion& confusion);

// Called with 0 to 1, after each epoch or take.
using Progress = std::function<void(double)>;
// Asked after each epoch: true ends the training.
using Stops = std::function<bool()>;

// From synthetic persons alone.
Network train_synthetic(Source source, const TrainingParams& params, const Progress& progress = {});
// The same; nullopt if it was ended before it had learned.
std::optional<Network> train_synthetic_until(Source source, const TrainingParams& params,
                                             const Stops& stops, const Progress& progress = {});

// The network goes on to learn from the user's takes, mixed with synthetic ones.
Network train_own(const Network& synthetic, const Recording& own, const TrainingParams& params);

// Each take of the user is told by a network that learned from the other takes. Empty where no
// emotion has two takes.
Confusion leave_one_take_out(const Network& synthetic, const Recording& own,
                             const TrainingParams& params, const Progress& progress = {});

// Windows of a recording, each person calibrated with the first 2 s of their first neutral take.
// `missing`: that share of the channels is absent, other ones in each take. Decisions are those of
// single windows, without smoothing.
Confusion confusion_of(const Network& network, const Recording& recording, double missing = 0,
                       std::uint64_t seed = 1);

// A sentence on why the network cannot learn from the takes; empty if it can.
std::string problem_of_own(const Recording& own);

}  // namespace theatron::face
