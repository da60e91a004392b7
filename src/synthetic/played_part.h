// SPDX-License-Identifier: Apache-2.0
// The part of a loop that is played while the rest is still being rendered: forwards and backwards,
// so that nothing jumps, and longer with each turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

namespace theatron::synthetic {

// Shared by the cameras of one room, which therefore show the same moment of it. Any thread.
class PlayedPart {
public:
    explicit PlayedPart(std::size_t frames_of_loop) : whole_(frames_of_loop) {}

    // A further camera that has this number of frames, at least one, from the first on. Returns its
    // index.
    std::size_t add_camera(std::size_t frames);
    void note_frames(std::size_t camera, std::size_t frames);

    // The frame of the loop that every camera shows as its picture `number`, which counts from 0
    // and may be asked for again or a little late. Every camera that was added before has it.
    std::size_t frame_at(std::uint64_t number);
    // The number of the newest picture that was asked for, with which a further camera begins.
    std::uint64_t newest();

private:
    // Pictures from `begin` on: one turn forwards and backwards, or the loop once if it is whole.
    struct Turn {
        std::uint64_t begin = 0;
        std::size_t frames = 0, pictures = 0;
    };
    Turn next_turn(std::uint64_t begin) const;

    const std::size_t whole_;
    std::mutex mutex_;  // guards the members below
    std::vector<std::size_t> frames_;
    std::deque<Turn> turns_;  // the newest last
    std::uint64_t newest_ = 0;
};

}  // namespace theatron::synthetic
