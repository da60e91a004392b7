// SPDX-License-Identifier: Apache-2.0
// An operating room that exists only here, with exact ground truth: a table with
// a draped patient and an open situs, a surgeon and an assistant at work, lamps,
// instruments, a monitor. It moves in a loop without a seam and looks the same
// for the same options on every machine of one kind.
//
// OperatingRoom holds the scene. RoomMoment is the scene at one time, RoomView
// one camera's eyes. Make one of each and combine them:
//
//     const OperatingRoom room({.seed = 3});
//     const auto view = room.look_from(synthetic_camera(Variant::room, 0, 2, {1280, 720}));
//     const auto moment = room.at(2s);
//     const GroundTruth truth = view->render(*moment);
//
// Room frame: metres, y up, origin on the floor; the table's centre is above the
// origin, its length along x (patient's head at -x); the surgeon stands at +z.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "base/time.h"
#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron::synthetic {

enum class Variant : std::uint8_t {
    room,     // cameras around the table that look at the situs
    surgeon,  // cameras close to the surgeon, who fills the picture
};

struct SceneOptions {
    std::uint32_t seed = 1;
    Duration loop = 20s;  // 2 s to 2 min; hands move at a natural speed near 20 s
    // 1: full quality. Smaller values make coarser meshes, faster (tests use 0.3).
    double detail = 1;
    // Without them nothing moves: no team, no patient, no sheets over the table, none
    // of the tools that pass from hand to hand.
    bool people = true;
};

// What a pixel shows. The numbers are stable: they are stored and compared.
enum class Material : std::uint8_t {
    none,  // the ray hits nothing
    wall,
    floor,
    door,
    plastic,
    metal,     // brushed or painted
    polished,  // instruments: bright, mirror-like
    rubber,    // mattress, castors, shoes
    glass,     // lamp faces, screens
    drape,     // the patient's cover
    gown,
    cap,
    mask,
    glove,
    skin,
    eye,
    hair,
    tissue,  // wet, red: muscle, bowel, vessels
    liver,
    fat,
    gauze,
    paper,  // printed text
    brick,
    screen,  // monitor picture
    scrubs,  // trousers below the gown
    count
};

std::string_view to_text(Material material);

// What a pixel's surface is like, for a model of the depth sensor.
struct SurfaceSample {
    // Unit normal in the camera's frame, towards the camera (dot with the ray < 0).
    float nx = 0, ny = 0, nz = 0;
    // Share of near infrared light (850 nm) that is sent back diffusely, 0 to 1.
    float infrared = 0;
    // Share of mirror-like reflection, 0 to 1: high on metal, glass and wet tissue.
    float specular = 0;
    Material material = Material::none;
};

// Exact images of one moment. Images that were not asked for are empty.
struct GroundTruth {
    // Distance along the axis (z, as depth cameras give it) in metres at each
    // depth pixel's centre ray; 0 where the lens images nothing.
    Image<float> depth_m;
    Image<SurfaceSample> surface;  // beside each depth pixel
    ColorImage color;              // noise-free, sRGB, as the colour camera sees it
};

struct RenderOptions {
    bool depth = true;
    bool surface = false;  // needs depth
    bool color = true;
    bool operator==(const RenderOptions&) const = default;
};

// The scene at one time. Immutable; may be shared by threads.
class RoomMoment {
public:
    virtual ~RoomMoment() = default;
    virtual Duration time() const = 0;
};

// One camera in the room. Keeps a picture of all that never moves, so the first
// picture is slow and the others fast. Used by one thread at a time.
class RoomView {
public:
    virtual ~RoomView() = default;
    virtual const Calibration& calibration() const = 0;
    virtual GroundTruth render(const RoomMoment& moment) = 0;
    // The same view for another thread; what never moves is kept once for both.
    virtual std::unique_ptr<RoomView> share() const = 0;
};

// Immutable after construction, which takes some seconds at full detail. Safe to
// use from several threads; must outlive its views and moments.
class OperatingRoom {
public:
    explicit OperatingRoom(const SceneOptions& options = {});
    ~OperatingRoom();

    const SceneOptions& options() const;
    Duration loop_duration() const { return options().loop; }

    // The scene `time` after the start; times beyond the loop wrap around.
    std::shared_ptr<const RoomMoment> at(Duration time) const;

    // `camera.room_from_camera` is where its depth camera is. Any camera model
    // will do; colour is rendered only where `camera.color` has a size.
    std::unique_ptr<RoomView> look_from(const Calibration& camera,
                                        const RenderOptions& options = {}) const;

    // Both in one step, for a single picture.
    GroundTruth render(const Calibration& camera, Duration time,
                       const RenderOptions& options = {}) const;

private:
    struct Scene;
    std::unique_ptr<const Scene> scene_;
};

// The pose, lenses and offsets of camera `index` of `count`: an Azure Kinect in
// its narrow field of view, 640x576, mask by inside_hexagon(),
// and a colour camera of this size, {0, 0} for none. Registered.
inline constexpr int max_cameras = 12;
Calibration synthetic_camera(Variant variant, int index, int count, Size color);

// A pinhole without distortion for depth and colour at the same place, looking
// from `eye` at `target` (room frame).
Calibration free_viewpoint(Vec3 eye, Vec3 target, Size size, double horizontal_fov_degrees);

// Whether the depth camera's pixel lies inside the illuminated hexagon. The
// ground truth has depth everywhere the lens images; the sensor only here.
bool inside_hexagon(Size image, int x, int y);

// Changes whenever the pictures do: part of the key of anything that is cached.
inline constexpr int scene_version = 2;

}  // namespace theatron::synthetic
