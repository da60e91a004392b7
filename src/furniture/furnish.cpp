// SPDX-License-Identifier: Apache-2.0
#include "furniture/furnish.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "furniture/pieces.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;
// A depth camera measures hardly farther.
constexpr double seen_to_m = 4.5;

void include(Box& box, Vec3 p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

Box turned(const Box& box, const Pose& pose) {
    Box around{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
    for (int i = 0; i < 8; ++i)
        include(around, pose * Vec3{i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                    i & 4 ? box.high.z : box.low.z});
    return around;
}

// Boxes that only touch do not overlap.
bool overlap(const Box& a, const Box& b) {
    constexpr double touch_m = 0.01;
    return a.low.x + touch_m < b.high.x && b.low.x + touch_m < a.high.x &&
           a.low.y + touch_m < b.high.y && b.low.y + touch_m < a.high.y &&
           a.low.z + touch_m < b.high.z && b.low.z + touch_m < a.high.z;
}

bool fits(const Box& box, const Extent& e) {
    constexpr double touch_m = 0.01;
    return box.low.x > e.left - touch_m && box.high.x < e.right + touch_m &&
           box.low.z > e.back - touch_m && box.high.z < e.front + touch_m &&
           box.high.y < e.height + touch_m;
}

class Furnisher {
public:
    Furnisher(const Extent& extent, const std::vector<Calibration>& cameras)
        : extent_(extent), cameras_(cameras) {}

    // At this place; `turn` about y in degrees, 0: the front faces +z. Pieces of one group may
    // overlap.
    void put(std::string_view name, Model model, Vec3 at, double turn, bool blocks,
             bool overlaps = false, bool casts_shadow = true) {
        const Pose pose{rotation_about({0, 1, 0}, turn * pi / 180), at};
        const Box box = turned(bounds(model), pose);
        if (!fits(box, extent_))
            return;
        if (!overlaps && std::any_of(boxes_.begin(), boxes_.end(),
                                     [&](const Box& other) { return overlap(box, other); }))
            return;
        // Space is kept also for what gives way, so that the rest stands where it stands.
        boxes_.push_back(box);
        if (std::any_of(cameras_.begin(), cameras_.end(),
                        [&](const Calibration& camera) { return is_seen(box, camera); }))
            return;
        pieces_.push_back({name, pose, box, blocks, casts_shadow, std::move(model)});
    }
    // At a wall, `along` from its middle to the right of somebody who faces it.
    enum class Wall { back, front, left, right };
    void hang(std::string_view name, Model model, Wall wall, double along, bool blocks,
              double off = 0) {
        const Extent& e = extent_;
        const double x = (e.left + e.right) / 2, z = (e.back + e.front) / 2;
        switch (wall) {
            case Wall::back:
                return put(name, std::move(model), {x + along, 0, e.back + off}, 0, blocks);
            case Wall::front:
                return put(name, std::move(model), {x - along, 0, e.front - off}, 180, blocks);
            case Wall::left:
                return put(name, std::move(model), {e.left + off, 0, z - along}, 90, blocks);
            case Wall::right:
                return put(name, std::move(model), {e.right - off, 0, z + along}, -90, blocks);
        }
    }
    std::vector<Piece> pieces() { return std::move(pieces_); }

private:
    const Extent& extent_;
    const std::vector<Calibration>& cameras_;
    std::vector<Box> boxes_;
    std::vector<Piece> pieces_;
};

}  // namespace

std::vector<Box> obstacles_of(const Piece& piece) {
    constexpr double slice_m = 0.2;
    const Vec3 size = piece.box.high - piece.box.low;
    const bool along_x = size.x > size.z;
    const double from = along_x ? piece.box.low.x : piece.box.low.z,
                 whole = along_x ? size.x : size.z;
    const int count = std::max(1, int(std::ceil(whole / slice_m)));
    const double slice = whole / count;
    std::vector<Box> boxes(std::size_t(count), Box{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}});
    for (const Model::Part& part : piece.model.parts)
        for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
            Box box{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& v = part.mesh.vertices[part.mesh.indices[i + k]];
                include(box, piece.room_from_piece * Vec3{v.px, v.py, v.pz});
            }
            const auto number = [&](const Vec3& p) {
                return std::clamp(int(((along_x ? p.x : p.z) - from) / slice), 0, count - 1);
            };
            for (int n = number(box.low); n <= number(box.high); ++n) {
                const double begin = from + slice * n, end = begin + slice;
                Box part_of = box;
                double& low = along_x ? part_of.low.x : part_of.low.z;
                double& high = along_x ? part_of.high.x : part_of.high.z;
                low = std::max(low, begin);
                high = std::min(high, end);
                include(boxes[std::size_t(n)], part_of.low);
                include(boxes[std::size_t(n)], part_of.high);
            }
        }
    std::erase_if(boxes, [](const Box& box) { return box.low.x > box.high.x; });
    return boxes;
}

bool is_seen(const Box& box, const Calibration& camera) {
    if (!camera.registered)
        return false;
    const Pose camera_from_room = inverse(camera.room_from_camera);
    const Size size = camera.depth.size;
    for (int i = 0; i < 27; ++i) {
        const auto between = [](double low, double high, int step) {
            return low + (high - low) * step / 2;
        };
        const Vec3 p = camera_from_room * Vec3{between(box.low.x, box.high.x, i % 3),
                                               between(box.low.y, box.high.y, i / 3 % 3),
                                               between(box.low.z, box.high.z, i / 9)};
        if (p.z <= 0 || length(p) > seen_to_m)
            continue;
        const auto pixel = project(camera.depth, p);
        if (pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x < size.width &&
            pixel->y < size.height)
            return true;
    }
    return false;
}

std::vector<Piece> furnish(const Extent& extent, const std::vector<Calibration>& cameras) {
    using Wall = Furnisher::Wall;
    Furnisher f(extent, cameras);
    const double height = extent.height;
    // Around the table. People begin at 1.5 m from its middle: from 1.15 to 1.85 m the floor is
    // free.
    f.put("operating table", operating_table(), {}, 0, true);
    f.put("instrument stand", instrument_stand(), {}, 0, true, true);
    f.put("table lamps", table_lamps(height), {}, 0, false, true, false);
    f.put("ceiling panel", ceiling_panel(height), {}, 0, false, true, false);
    f.put("infusion stand", infusion_stand(), {-0.85, 0, -2.0}, 20, true);
    // At the table's head, and behind the surgeons.
    f.put("anaesthesia machine", anaesthesia_machine(), {-2.30, 0, 0.75}, 90, true);
    f.put("supply unit", supply_unit(height), {-2.05, 0, -1.35}, 60, true);
    f.put("suction unit", suction_unit(), {-1.45, 0, -1.95}, 20, true);
    f.put("hanging monitor", hanging_monitor(height), {1.75, 0, -1.45}, -40, true);
    f.put("electrosurgery cart", electrosurgery_cart(), {0.55, 0, 2.25}, 170, true);
    f.put("stool", stool(), {-1.1, 0, 1.85}, 0, true);
    f.put("second stool", stool(), {1.95, 0, 0.95}, 30, true);
    f.put("instrument table", instrument_table(), {1.30, 0, -2.30}, 0, true);
    // Back wall.
    f.hang("wall monitor", wall_monitor(), Wall::back, -0.95, true);
    f.hang("second wall monitor", wall_monitor(), Wall::back, 0.55, true);
    f.hang("socket rail", socket_rail(), Wall::back, -2.55, false);
    f.hang("waste bin", waste_bin(Material::yellow), Wall::back, 2.55, true, 0.3);
    f.hang("second waste bin", waste_bin(Material::blue), Wall::back, 3.05, true, 0.3);
    // Right wall: supplies.
    f.hang("glass cabinet", glass_cabinet(), Wall::right, -1.95, true);
    f.hang("second glass cabinet", glass_cabinet(), Wall::right, -0.70, true);
    f.hang("drawer cabinet", drawer_cabinet(), Wall::right, 0.85, true);
    f.hang("light box", light_box(), Wall::right, 0.85, false);
    f.hang("air grille", air_grille(), Wall::right, 2.4, false);
    // Front wall: the doors, and the way to wash one's hands.
    f.hang("double door", double_door(), Wall::front, 0.6, false);
    f.hang("clock", wall_clock(), Wall::front, 0.6, false);
    f.hang("door panel", door_panel(), Wall::front, 1.85, false);
    f.hang("dispenser", dispenser(), Wall::front, 2.25, false);
    f.hang("exit sign", exit_sign(), Wall::front, -0.1, false);
    f.hang("scrub sink", scrub_sink(), Wall::front, -1.75, true);
    f.hang("linen trolley", linen_trolley(), Wall::front, 2.9, true, 0.32);
    // Left wall.
    f.hang("second socket rail", socket_rail(), Wall::left, 0.2, false);
    f.hang("ultrasound cart", ultrasound_cart(), Wall::left, -2.4, true, 0.4);
    f.hang("second air grille", air_grille(), Wall::left, 2.4, false);
    f.put("step", step(), {0.05, 0, 0.80}, 0, false, true);
    // Between what hangs from the ceiling.
    f.put("ceiling lights", ceiling_lights(height), {}, 0, false, true, false);
    return f.pieces();
}

}  // namespace theatron::furniture
