// SPDX-License-Identifier: Apache-2.0
// One camera's pictures. Static parts are drawn once, with their depth. Each moment draws only
// the moving parts over them, and their shadows.
#include <numeric>

#include "synthetic/synthetic_view.h"

namespace theatron::synthetic {
namespace {

constexpr int samples_per_side = 2;
constexpr int still_passes = 3;  // each with other sample positions in the pixel

// One mesh in a camera's frame, with its inputs for shading.
struct Drawn {
    const Mesh& mesh;                  // textures, openness, triangles
    const std::vector<F3>& positions;  // in the room
    const std::vector<F3>& normals;
    std::vector<F3> camera;  // positions in the camera's frame
};

struct Hit {
    Look look{};
    F3 room, normal, texture;
    float openness = 1;
    float footprint = 0;
};

Hit hit_of(const Drawn& d, std::uint32_t triangle, Ray ray, float z, float pixel_angle) {
    const Triangle& t = d.mesh.triangles[triangle];
    const F3 w = corner_weights(d.camera[t.a], d.camera[t.b], d.camera[t.c], ray);
    const auto blend = [&](const std::vector<F3>& v) {
        return v[t.a] * w.x + v[t.b] * w.y + v[t.c] * w.z;
    };
    Hit hit;
    hit.look = t.look;
    hit.room = blend(d.positions);
    hit.normal = normalized(blend(d.normals));
    hit.texture = blend(d.mesh.textures);
    const auto& o = d.mesh.openness;
    hit.openness = o[t.a] * w.x + o[t.b] * w.y + o[t.c] * w.z;
    hit.footprint = z * pixel_angle;
    const Material material = traits(t.look).material;
    if (material == Material::paper || material == Material::screen) {
        // Printed pictures measure blur relative to their own width.
        const float room_size = length(d.positions[t.b] - d.positions[t.a]);
        const F3 step = d.mesh.textures[t.b] - d.mesh.textures[t.a];
        hit.footprint *= std::hypot(step.x, step.y) / std::max(room_size, 1e-6f);
    }
    return hit;
}

class View final : public RoomView {
public:
    View(const SceneData& scene, const Calibration& camera, const RenderOptions& options,
         const Pulse& pulse);

    const Calibration& calibration() const override { return calibration_; }
    GroundTruth render(const RoomMoment& moment, const Pulse& pulse) override;
    std::unique_ptr<RoomView> share() const override { return std::make_unique<View>(*this); }

private:
    struct Eye {
        Affine camera_from_room;
        F3 position;
        SampleGrid grid;
        Visibility still;  // of the static parts
        float pixel_angle = 0;
    };
    // Everything that is equal in all moments.
    struct Still {
        Eye depth_eye, color_eye;
        Image<SurfaceSample> surface;
        Image<LitPoint> light;  // a pixel's mean
        Image<F3> points;       // positions in the room, for shadows
    };
    static Eye make_eye(const Pose& room_from_eye, const CameraModel& model, int per_side);
    LitPoint shade(const Hit& hit, const Eye& eye) const;
    void draw_still_depth(Still& still, const Pulse& pulse) const;
    void draw_still_color(Still& still, const Pulse& pulse) const;
    void render_color(const PosedMoment& moment, ColorImage& out, const Pulse& pulse);
    void render_depth(const PosedMoment& moment, GroundTruth& out, const Pulse& pulse);
    SurfaceSample surface_of(const Drawn& drawn, const Eye& eye, std::uint32_t triangle, Ray ray,
                             float z) const;
    Drawn draw_moving(const PosedMoment& moment, const Eye& eye, const Pulse& pulse);

    const SceneData& scene_;
    Calibration calibration_;
    RenderOptions options_;
    std::shared_ptr<const Still> still_;
    Visibility seen_;  // reused
};

View::Eye View::make_eye(const Pose& room_from_eye, const CameraModel& model, int per_side) {
    Eye eye;
    eye.camera_from_room = to_affine(inverse(room_from_eye));
    eye.position = to_f3(room_from_eye.translation);
    eye.grid = make_grid(model);
    if (per_side > 1)
        eye.grid = make_fine_grid(model, eye.grid.rays, per_side, {});
    eye.pixel_angle = float(1 / model.fx);
    return eye;
}

View::View(const SceneData& scene, const Calibration& camera, const RenderOptions& options,
           const Pulse& pulse)
    : scene_(scene), calibration_(camera), options_(options) {
    auto still = std::make_shared<Still>();
    if (options.depth)
        draw_still_depth(*still, pulse);
    if (options.color && camera.color.size.area() > 0)
        draw_still_color(*still, pulse);
    still_ = std::move(still);
}

void View::draw_still_depth(Still& still, const Pulse& pulse) const {
    const Mesh& mesh = scene_.still;
    still.depth_eye = make_eye(calibration_.room_from_camera, calibration_.depth, 1);
    Eye& eye = still.depth_eye;
    Drawn drawn{mesh, mesh.positions, mesh.normals, {}};
    transform(mesh.positions, eye.camera_from_room, drawn.camera);
    eye.still.clear(calibration_.depth.size);
    rasterise(eye.grid, drawn.camera, mesh.triangles, 0, eye.still, pulse);
    if (options_.surface) {
        still.surface.resize(calibration_.depth.size);
        for (std::size_t i = 0; i < still.surface.pixels.size(); ++i)
            if (eye.still.triangles.pixels[i] != no_triangle)
                still.surface.pixels[i] =
                    surface_of(drawn, eye, eye.still.triangles.pixels[i], eye.grid.rays.pixels[i],
                               eye.still.depth.pixels[i]);
    }
    // From here on, "no triangle" means: no moving triangle.
    std::fill(eye.still.triangles.pixels.begin(), eye.still.triangles.pixels.end(), no_triangle);
}

LitPoint View::shade(const Hit& hit, const Eye& eye) const {
    const F3 toward_eye = normalized(eye.position - hit.room);
    const Appearance look =
        appearance(hit.look, hit.texture, hit.normal, hit.footprint, scene_.pictures);
    LitPoint lit = light_point(look, hit.room, toward_eye, hit.openness);
    for (std::size_t l = 0; l < scene_.still_shadows.size(); ++l) {
        const auto shadow = scene_.still_shadows[l].at(hit.room);
        lit.lamp[l] = lit.lamp[l] * shadow.lit;
    }
    return lit;
}

void View::draw_still_color(Still& still, const Pulse& pulse) const {
    const Size size = calibration_.color.size;
    const Pose room_from_color =
        calibration_.room_from_camera * inverse(calibration_.color_from_depth);
    still.color_eye = make_eye(room_from_color, calibration_.color, 1);
    Eye& eye = still.color_eye;
    const Image<Ray> centres = std::move(eye.grid.rays);
    const Mesh& mesh = scene_.still;
    Drawn drawn{mesh, mesh.positions, mesh.normals, {}};
    transform(mesh.positions, eye.camera_from_room, drawn.camera);

    still.light.resize(size);
    still.points.resize(size);
    constexpr int n = samples_per_side;
    // The last pass has no shift; its depth is kept.
    static constexpr Vec2 shifts[still_passes] = {{0.33, -0.33}, {-0.33, 0.33}, {0, 0}};
    for (int pass = 0; pass < still_passes; ++pass) {
        eye.grid = make_fine_grid(calibration_.color, centres, n, shifts[pass]);
        eye.still.clear(eye.grid.rays.size);
        rasterise(eye.grid, drawn.camera, mesh.triangles, 0, eye.still, pulse);
        for (int y = 0; y < size.height; ++y) {
            if (pulse)
                pulse();
            for (int x = 0; x < size.width; ++x) {
                // Samples with equal look and direction are lit together.
                std::array<Hit, n * n> hits;
                std::array<float, n * n> shares{};
                int known = 0;
                for (int s = 0; s < n * n; ++s) {
                    const int sx = x * n + s % n, sy = y * n + s / n;
                    const std::uint32_t id = eye.still.triangles.view().row(sy)[sx];
                    if (id == no_triangle)
                        continue;
                    const float z = eye.still.depth.view().row(sy)[sx];
                    const Hit hit = hit_of(drawn, id, eye.grid.rays.view().row(sy)[sx], z,
                                           eye.pixel_angle * 0.7f);
                    int k = 0;
                    while (k < known && !(hits[std::size_t(k)].look == hit.look &&
                                          dot(hits[std::size_t(k)].normal, hit.normal) > 0.97f))
                        ++k;
                    if (k == known)
                        hits[std::size_t(known++)] = hit;
                    shares[std::size_t(k)] += 1.0f / (n * n * still_passes);
                    if (pass == still_passes - 1 && s == 0)
                        still.points.view().row(y)[x] = hit.room;
                }
                LitPoint& sum = still.light.view().row(y)[x];
                for (std::size_t k = 0; k < std::size_t(known); ++k) {
                    const LitPoint lit = shade(hits[k], eye);
                    // Limits glints, so that one sample does not dominate the pixel.
                    const auto tame = [&](F3 v) {
                        return F3{std::min(v.x, 4.0f), std::min(v.y, 4.0f), std::min(v.z, 4.0f)} *
                               shares[k];
                    };
                    sum.base += tame(lit.base);
                    for (std::size_t l = 0; l < lamp_count; ++l)
                        sum.lamp[l] += tame(lit.lamp[l]);
                }
            }
        }
    }
    std::fill(eye.still.triangles.pixels.begin(), eye.still.triangles.pixels.end(), no_triangle);
}

Drawn View::draw_moving(const PosedMoment& moment, const Eye& eye, const Pulse& pulse) {
    Drawn drawn{scene_.moving.mesh, moment.positions, moment.normals, {}};
    transform(moment.positions, eye.camera_from_room, drawn.camera);
    seen_ = eye.still;
    rasterise(eye.grid, drawn.camera, drawn.mesh.triangles, 0, seen_, pulse);
    return drawn;
}

void View::render_color(const PosedMoment& moment, ColorImage& out, const Pulse& pulse) {
    const Eye& eye = still_->color_eye;
    const Drawn drawn = draw_moving(moment, eye, pulse);
    const Size size = calibration_.color.size;
    out.resize(size);
    constexpr int n = samples_per_side;
    constexpr float share = 1.0f / (n * n);
    for (int y = 0; y < size.height; ++y) {
        if (pulse)
            pulse();
        const LitPoint* still = still_->light.view().row(y);
        const F3* points = still_->points.view().row(y);
        Rgb* row = out.view().row(y);
        const std::uint32_t* ids[n];
        const float* depths[n];
        const Ray* rays[n];
        for (int s = 0; s < n; ++s) {
            ids[s] = seen_.triangles.view().row(y * n + s);
            depths[s] = seen_.depth.view().row(y * n + s);
            rays[s] = eye.grid.rays.view().row(y * n + s);
        }
        for (int x = 0; x < size.width; ++x) {
            F3 light{};
            int moving = 0;
            // Samples with equal look are lit together.
            std::array<Look, n * n> looks;
            std::array<F3, n * n> lights;
            int known = 0;
            for (int s = 0; s < n * n; ++s) {
                const int sx = x * n + s % n;
                const std::uint32_t id = ids[s / n][sx];
                if (id == no_triangle)
                    continue;
                ++moving;
                const Look look = drawn.mesh.triangles[id].look;
                int k = 0;
                while (k < known && looks[std::size_t(k)] != look)
                    ++k;
                if (k == known) {
                    const Hit hit =
                        hit_of(drawn, id, rays[s / n][sx], depths[s / n][sx], eye.pixel_angle);
                    const LitPoint lit = shade(hit, eye);
                    F3 sum = lit.base;
                    float open = 1;
                    for (std::size_t l = 0; l < lamp_count; ++l) {
                        const auto shadow = moment.shadows[l].at(hit.room);
                        open = std::min(open, shadow.open);
                        sum += lit.lamp[l] * shadow.lit;
                    }
                    looks[std::size_t(known)] = look;
                    lights[std::size_t(known++)] = sum + lit.base * (open - 1);
                }
                light += lights[std::size_t(k)] * share;
            }
            if (moving < n * n) {
                F3 sum = still[x].base;
                float open = 1;
                for (std::size_t l = 0; l < lamp_count; ++l) {
                    const auto shadow = moment.shadows[l].at(points[x]);
                    open = std::min(open, shadow.open);
                    sum += still[x].lamp[l] * shadow.lit;
                }
                light += (sum + still[x].base * (open - 1)) * (1 - share * float(moving));
            }
            row[x] = tone_map(light);
        }
    }
}

SurfaceSample View::surface_of(const Drawn& drawn, const Eye& eye, std::uint32_t triangle, Ray ray,
                               float z) const {
    const Hit hit = hit_of(drawn, triangle, ray, z, eye.pixel_angle);
    // The flat normal of the triangle matches its depth. The smooth normal is for colour.
    const Triangle& t = drawn.mesh.triangles[triangle];
    const F3 a = drawn.camera[t.a];
    const F3 n = normalized(cross(drawn.camera[t.b] - a, drawn.camera[t.c] - a));
    SurfaceSample s;
    s.nx = n.x;
    s.ny = n.y;
    s.nz = n.z;
    s.material = traits(hit.look).material;
    s.infrared = clamp01(infrared(hit.look, hit.texture, scene_.pictures));
    s.specular = clamp01(traits(hit.look).specular * 0.5f + traits(hit.look).mirror);
    return s;
}

void View::render_depth(const PosedMoment& moment, GroundTruth& out, const Pulse& pulse) {
    const Eye& eye = still_->depth_eye;
    const Drawn drawn = draw_moving(moment, eye, pulse);
    out.depth_m = seen_.depth;
    for (float& d : out.depth_m.pixels)
        if (d == nothing_seen)
            d = 0;
    if (!options_.surface)
        return;
    out.surface = still_->surface;
    for (std::size_t i = 0; i < seen_.triangles.pixels.size(); ++i)
        if (seen_.triangles.pixels[i] != no_triangle)
            out.surface.pixels[i] = surface_of(drawn, eye, seen_.triangles.pixels[i],
                                               eye.grid.rays.pixels[i], seen_.depth.pixels[i]);
}

GroundTruth View::render(const RoomMoment& moment, const Pulse& pulse) {
    const auto& posed = static_cast<const PosedMoment&>(moment);
    GroundTruth truth;
    if (options_.depth)
        render_depth(posed, truth, pulse);
    if (!still_->light.empty())
        render_color(posed, truth.color, pulse);
    return truth;
}

}  // namespace

std::unique_ptr<RoomView> make_view(const SceneData& scene, const Calibration& camera,
                                    const RenderOptions& options, const Pulse& pulse) {
    return std::make_unique<View>(scene, camera, options, pulse);
}

}  // namespace theatron::synthetic
