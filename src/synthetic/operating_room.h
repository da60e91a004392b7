// SPDX-License-Identifier: Apache-2.0
// A generated operating room with exact ground truth: a table with a draped patient and an
// open situs, a surgeon and an assistant at work, lamps, instruments, a monitor. Its motion is
// a seamless loop. Equal options give equal pictures on all machines of one kind.
//
// OperatingRoom is the scene, RoomMoment the scene at one time, RoomView the scene as one
// camera sees it. Make one of each and combine them:
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
#include "synthetic/pulse.h"

namespace theatron::synthetic {

enum class Variant : std::uint8_t {
    room,     // cameras around the table that look at the situs
    surgeon,  // cameras close to the surgeon, who fills the picture
};

struct SceneOptions {
    std::uint32_t seed = 1;
    Duration loop = 20s;  // 2 s to 2 min; hands move at a natural speed near 20 s
    // Mesh resolution; 1 is full quality. Smaller values are faster (tests use 0.3).
    double detail = 1;
    // False: no team, no patient, no sheets over the table and none of the tools that are
    // handed over, so that nothing moves.
    bool people = true;
};

// The material of a pixel. The numbers are stable, because they are stored and compared.
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

// Surface properties of a pixel, the input of a depth sensor model.
struct SurfaceSample {
    // Unit normal in the camera's frame, facing the camera (dot with the ray < 0).
    float nx = 0, ny = 0, nz = 0;
    // Share of near infrared light (850 nm) reflected diffusely, 0 to 1.
    float infrared = 0;
    // Share reflected specularly, 0 to 1: high on metal, glass and wet tissue.
    float specular = 0;
    Material material = Material::none;
};

// Exact images of one moment. Images that were not requested are empty.
struct GroundTruth {
    // Distance along the optical axis (z, as of depth cameras) in metres, at the ray through
    // each depth pixel's centre; 0 outside the lens' valid circle.
    Image<float> depth_m;
    Image<SurfaceSample> surface;  // of each depth pixel
    ColorImage color;              // noise-free, sRGB, as the colour camera sees it
};

struct RenderOptions {
    bool depth = true;
    bool surface = false;  // needs depth
    bool color = true;
    bool operator==(const RenderOptions&) const = default;
};

// The scene at one time. Immutable; threads may share it.
class RoomMoment {
public:
    virtual ~RoomMoment() = default;
    virtual Duration time() const = 0;
};

// One camera in the room. Caches the static parts, so the first picture is slow and all
// others are fast. One thread at a time.
class RoomView {
public:
    virtual ~RoomView() = default;
    virtual const Calibration& calibration() const = 0;
    virtual GroundTruth render(const RoomMoment& moment, const Pulse& pulse = {}) = 0;
    // The same view for another thread; both share the static parts.
    virtual std::unique_ptr<RoomView> share() const = 0;
};

// Immutable after construction, which takes some seconds at full detail. Thread-safe. Must
// outlive its views and moments.
class OperatingRoom {
public:
    explicit OperatingRoom(const SceneOptions& options = {}, const Pulse& pulse = {});
    ~OperatingRoom();

    const SceneOptions& options() const;
    Duration loop_duration() const { return options().loop; }

    // The scene `time` after the start; times beyond the loop wrap around.
    std::shared_ptr<const RoomMoment> at(Duration time) const;

    // `camera.room_from_camera` is the pose of the depth camera. Any camera model is allowed.
    // Colour is rendered only if `camera.color` has a size.
    std::unique_ptr<RoomView> look_from(const Calibration& camera,
                                        const RenderOptions& options = {},
                                        const Pulse& pulse = {}) const;

    // A view and a moment for a single picture.
    GroundTruth render(const Calibration& camera, Duration time,
                       const RenderOptions& options = {}) const;

private:
    struct Scene;
    std::unique_ptr<const Scene> scene_;
};

// Pose, lenses and offsets of camera `index` of `count`: an Azure Kinect in its narrow field
// of view, 640x576, masked by inside_hexagon(), with a colour camera of size `color`,
// {0, 0} for none. Registered.
inline constexpr int max_viewpoints = 12;
Calibration synthetic_camera(Variant variant, int index, int count, Size color);

// A pinhole camera without distortion, depth and colour at the same place, at `eye` facing
// `target` (room frame).
Calibration free_viewpoint(Vec3 eye, Vec3 target, Size size, double horizontal_fov_degrees);

// True if the depth camera's pixel is inside the illuminated hexagon. The ground truth has
// depth in the lens' whole circle, the sensor only here.
bool inside_hexagon(Size image, int x, int y);

// Incremented when the pictures change; part of all cache keys.
inline constexpr int scene_version = 2;

}  // namespace theatron::synthetic
