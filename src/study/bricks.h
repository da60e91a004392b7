// SPDX-License-Identifier: Apache-2.0
// The task of a study: a construction of interlocking bricks, and questions about it whose answers
// are known. Everything follows from a seed. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace theatron::study {

enum class BrickColor { red, blue, yellow, green, white, black };
inline constexpr int brick_colors = 6;
const char* name_of(BrickColor color);
const char* code_of(BrickColor color);  // "#c4281b"

// Studs along both sides, lengths in studs, height in layers from 0.
struct Brick {
    BrickColor color = BrickColor::red;
    int width = 2, depth = 2;  // along x and y
    int x = 0, y = 0, layer = 0;
    bool operator==(const Brick&) const = default;
};

// One is over a part of the other, whatever their layers are.
bool overlaps(const Brick& a, const Brick& b);

// The kind of a brick, however it is turned: "red 2x4".
std::string kind_of(const Brick& brick);

struct Construction {
    std::vector<Brick> bricks;  // in an order in which they can be put together from below
    bool operator==(const Construction&) const = default;
};

// Connected: each brick but the first holds to one below it or, in the lowest layer, to one above.
// At most 12 studs a side and 6 layers.
Construction make_construction(std::uint64_t seed, int bricks);

int count_bricks(const Construction& construction, BrickColor color);
// Studs of the colour on which no brick stands.
int free_studs(const Construction& construction, BrickColor color);
// One of each kind that the construction has can be taken from the set.
bool can_be_built(const Construction& construction, const std::vector<Brick>& set);

struct BrickQuestion {
    enum class Kind { bricks, studs, buildable };
    Kind kind = Kind::bricks;
    std::string text;
    int answer = 0;  // a number; 1 or 0 for yes or no
};

// Questions in turn of the three kinds; no two have the same text.
std::vector<BrickQuestion> make_questions(const Construction& construction, std::uint64_t seed,
                                          int count);

// Lines "layer 1: red 2x4 at 3,2", as a person reads them.
std::string construction_text(const Construction& construction);
// A drawing at true scale (a stud is 8 mm) of each layer from above, and the list of bricks; SVG,
// one page of A4. `title` is plain text.
std::string construction_plan(const Construction& construction, const std::string& title);
// Triangles of the bricks of one colour as Wavefront OBJ, millimetres, z up; empty: there are none.
std::string construction_obj(const Construction& construction, BrickColor color);

}  // namespace theatron::study
