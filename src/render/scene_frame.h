// SPDX-License-Identifier: Apache-2.0
// Everything in a picture except the clouds: the room, organs, people, panels, texts. The viewer
// owns the description; room, organs and people fill it again for each picture. No GL type
// appears here.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vec.h"
#include "image/image.h"
#include "render/draw_target.h"
#include "render/scene_lines.h"

namespace theatron::render {

class TriangleTree;

// Triangles with a normal at each corner, counter-clockwise seen from outside. Metres. A corner's
// place in a texture is (u, v), from (0, 0) at the upper left to (1, 1) at the lower right.
struct MeshData {
    struct Vertex {
        float px = 0, py = 0, pz = 0, nx = 0, ny = 0, nz = 0;
        float u = 0, v = 0;
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    // One for each corner, for surfaces with baked light (SurfaceLook); none: white.
    std::vector<Rgb> colors;
};

MeshData make_box_mesh(Vec3 low, Vec3 high);
// A rectangle for a texture, in the frame of SceneText: x right, y down, z away from the reader;
// the origin is in its middle.
MeshData make_panel_mesh(double width_m, double height_m);
MeshData make_sphere_mesh(double radius, int rings);

// A mesh on the GPU. Needs the GL context current in which it was made.
class SceneMesh {
public:
    explicit SceneMesh(const MeshData& data);
    ~SceneMesh();
    SceneMesh(SceneMesh&&) noexcept;
    SceneMesh& operator=(SceneMesh&&) noexcept;

    struct Buffers;
    const Buffers& buffers() const { return *buffers_; }
    // For picking; made at the first call.
    const TriangleTree& triangles() const;

private:
    std::unique_ptr<Buffers> buffers_;
};

// A picture on the GPU that surfaces can have. Needs the GL context current in which it was made.
class SceneTexture {
public:
    // Transparent black. Throws Error where the driver cannot draw into such a texture.
    explicit SceneTexture(Size size);
    ~SceneTexture();
    SceneTexture(SceneTexture&&) noexcept;
    SceneTexture& operator=(SceneTexture&&) noexcept;

    Size size() const;
    // Opaque; of the texture's size.
    void set(ColorView picture);
    // A target for drawing, instead of set(): with colour and opacity; row y = 0 is the upper one.
    // The drawing appears on surfaces after finish().
    DrawTarget target() const;
    void finish();

    struct Parts;
    const Parts& parts() const { return *parts_; }

private:
    std::unique_ptr<Parts> parts_;
};

// Metal-rough, as in glTF. Colours are linear, 0 to 1.
struct SurfaceLook {
    Vec3 base_color{0.8, 0.8, 0.8};
    double metallic = 0, roughness = 0.6;
    double opacity = 1;  // below 1: translucent
    double grid_m = 0;   // distance of faint lines in the room, which show scale; 0: none
    // Multiplies the colour; its opacity is used only if that of the surface is below 1.
    const SceneTexture* texture = nullptr;
    // For screens and panels: the texture's colours times base_color, without any light.
    bool unlit = false;
    // The light is in the colours already, those of the texture times those of the mesh's corners:
    // only shadows of other objects fall on the surface, and it casts none.
    bool baked = false;
};

// Names an object in the result of a pick (pick.h). The code that appends an object chooses it.
enum class PickId : std::uint32_t { none = 0 };

// A plane of the room that cuts an object: places with dot(normal, place) > distance_m are left
// out.
struct Cut {
    Vec3 normal;
    double distance_m = 0;
};

struct SceneObject {
    const SceneMesh* mesh = nullptr;
    Pose room_from_object;
    SurfaceLook look;
    // Floor and walls of the room, whose inside is convex. They are drawn behind everything else at
    // any distance, so that they never hide a real floor that was measured a little lower.
    bool backdrop = false;
    PickId id = PickId::none;               // none: rays pass through it
    double scale = 1;                       // metres of the room in a metre of the mesh
    std::optional<Cut> cut = std::nullopt;  // objects that are cut cast no shadows
    bool casts_shadow = true;
};

// One line of text. Its frame: x along the line, y down, z away from the reader; the origin is at
// the left end of the base line.
struct SceneText {
    std::string utf8;
    Pose room_from_text;
    double height_m = 0.05;  // of a capital letter, about
    Rgb color{255, 255, 255};
};

// A line that is seen at any distance (scene_lines.h). It casts no shadow.
struct SceneLine {
    const SceneLineMesh* mesh = nullptr;
    Pose room_from_line;
    Rgb color;
    // Surfaces hide it only where they are nearer to the eye by `nearer_m` and these metres a
    // metre of distance: a measured surface's noise does not cut it.
    double nearer_m = 0, nearer_per_distance = 0;
    double hidden_opacity = 0;  // behind surfaces
    std::optional<Cut> cut = std::nullopt;
};

// A lamp that lights a round place, brightest in its middle. It casts no shadows.
struct Spotlight {
    Vec3 place, target;
    double strength = 0;  // at a distance of one metre, as SceneFrame::light
    double slope = 0.4;   // radius of the lit place at a distance of one metre
};

// Quality of the scene's light and shadows; clouds do not depend on it.
enum class SceneQuality { low, high };

struct SceneFrame {
    std::vector<SceneObject> objects;
    std::vector<SceneText> texts;
    std::vector<SceneLine> lines;    // before translucent surfaces
    std::vector<SceneLabel> labels;  // after everything else
    Vec3 to_light{0.3, 1, 0.2};      // a direction
    double surroundings = 1;         // of the light from all around
    double light = 2.2;              // of white light, beside the surroundings' 1
    std::vector<Spotlight> spots;    // seen on high quality alone, the first two of them
    // All objects that cast shadows (the opaque ones that do, without the backdrop) lie in this
    // ball.
    Vec3 shadow_middle{0, 1, 0};
    double shadow_radius_m = 2.5;
    SceneQuality quality = SceneQuality::high;

    bool empty() const {
        return objects.empty() && texts.empty() && lines.empty() && labels.empty();
    }
};

}  // namespace theatron::render
