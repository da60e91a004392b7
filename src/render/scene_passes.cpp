// SPDX-License-Identifier: Apache-2.0
#include "render/scene_passes.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/environment.h"
#include "render/gl_driver.h"
#include "render/label_pass.h"
#include "render/line_pass.h"
#include "render/matrix.h"
#include "render/scene_mesh.h"
#include "render/text_pass.h"

namespace theatron::render {
namespace {

constexpr int environment_unit = 0, shadow_unit = 1, scene_depth_unit = 2, surface_unit = 3;
constexpr std::size_t most_spots = 2;  // as in scene.frag

void set_vector(GLint uniform, Vec3 v) {
    glUniform3f(uniform, float(v.x), float(v.y), float(v.z));
}

Mat4 place_of(const SceneObject& object) {
    Mat4 placed = matrix(object.room_from_object);
    for (std::size_t i = 0; i < 12; ++i)  // the first three columns
        placed.m[i] *= object.scale;
    return placed;
}

// The light's view of the ball that contains all shadow casters, without perspective.
struct LightView {
    Mat4 clip_from_room;
    explicit LightView(const SceneFrame& frame) {
        const Vec3 along = normalized(frame.to_light);
        const Vec3 up = std::abs(along.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        const double r = frame.shadow_radius_m;
        const Pose room_from_light =
            look_at(frame.shadow_middle + along * r, frame.shadow_middle, up);
        const Mat4 flat{{1 / r, 0, 0, 0, 0, -1 / r, 0, 0, 0, 0, 1 / r, 0, 0, 0, -1, 1}};
        clip_from_room = flat * matrix(inverse(room_from_light));
    }
};

// An unlit surface has a texture, if only a white one.
enum class Surface { plain, textured, unlit };

// Calls use(vertex, fragment) with the shaders of surfaces in one quality, with or without a
// texture and light: software drivers pay for all branches.
template <class Use>
auto lit_files(bool high, Surface surface, bool cuts, Use use) {
    const std::string_view quality = high ? "#define HIGH_QUALITY" : "#define LOW_QUALITY",
                           texture = surface == Surface::plain ? "#define PLAIN"
                                     : surface == Surface::textured
                                         ? "#define TEXTURED"
                                         : "#define TEXTURED\n#define UNLIT",
                           cutting = cuts ? "#define CUT" : "#define WHOLE";
    return use(ShaderFiles{quality, texture, "scene.vert"},
               ShaderFiles{"output.glsl", quality, texture, cutting, "scene.frag"});
}

// The same for surfaces whose light is in their colours, and for depth alone.
template <class Use>
auto baked_files(Use use) {
    return use(ShaderFiles{"baked.vert"}, ShaderFiles{"output.glsl", "baked.frag"});
}
template <class Use>
auto shadow_files(Use use) {
    return use(ShaderFiles{"scene_shadow.vert"}, ShaderFiles{"depth_only.frag"});
}

constexpr auto make_program = [](ShaderFiles vertex, ShaderFiles fragment) {
    return Program(vertex, fragment);
};

struct LitProgram {
    Program program;
    GLint clip_from_room = program.uniform("clip_from_room");
    GLint light_from_room = program.uniform("light_from_room");
    GLint eye = program.uniform("eye");
    GLint to_light = program.uniform("to_light");
    GLint light = program.uniform("light");
    GLint surroundings = program.uniform("surroundings");
    GLint shadow_texel = program.uniform("shadow_texel");
    GLint depth_from_w = program.uniform("depth_from_w");
    GLint occludes = program.uniform("occludes");
    GLint room_from_object = program.uniform("room_from_object");
    GLint base_color = program.uniform("base_color");
    GLint look = program.uniform("look");
    GLint tells_distance = program.uniform("tells_distance");
    GLint cut = program.uniform("cut");
    GLint spot_count = program.uniform("spot_count");
    GLint spot_place = program.uniform("spot_place");
    GLint spot_along = program.uniform("spot_along");
    GLint spot = program.uniform("spot");

    LitProgram(bool high, Surface surface, bool cuts)
        : program(lit_files(high, surface, cuts, make_program)) {
        program.set_sampler("environment", environment_unit);
        program.set_sampler("shadow_map", shadow_unit);
        program.set_sampler("scene_depth", scene_depth_unit);
        program.set_sampler("surface_texture", surface_unit);
    }
};

struct BakedProgram {
    Program program = baked_files(make_program);
    GLint clip_from_room = program.uniform("clip_from_room");
    GLint light_from_room = program.uniform("light_from_room");
    GLint room_from_object = program.uniform("room_from_object");
    GLint base_color = program.uniform("base_color");
    GLint tells_distance = program.uniform("tells_distance");

    BakedProgram() {
        program.set_sampler("shadow_map", shadow_unit);
        program.set_sampler("surface_texture", surface_unit);
    }
};

struct LitPicture {
    const SceneFrame& frame;
    const CameraView& view;
    bool occludes;  // with ambient occlusion
};

bool is_translucent(const SceneObject& object) {
    return object.look.opacity < 1;
}

}  // namespace

struct ScenePasses::Parts {
    std::optional<LitProgram> lit[2][3][2];  // high quality, Surface, cut; made when first used
    const LitProgram* in_use = nullptr;
    std::optional<BakedProgram> baked;  // made when first used
    bool baked_in_use = false;
    Program shadow = shadow_files(make_program);
    GLint shadow_clip_from_object = shadow.uniform("clip_from_object");
    SceneTexture white{{1, 1}};  // for surfaces without a texture
    Texture environment;
    Texture shadow_map;
    int shadow_side = 0;
    Framebuffer shadow_target;
    Texture scene_depth;
    Size scene_depth_size;
    Framebuffer scene_depth_target;
    LinePass line;
    std::optional<TextPass> text;
    LabelPass label;

    explicit Parts(const FontAtlas* atlas) {
        glActiveTexture(GL_TEXTURE0 + environment_unit);
        environment = make_environment();
        constexpr Rgb one{255, 255, 255};
        white.set({&one, {1, 1}});
        if (atlas)
            text.emplace(*atlas);
    }

    void make_scene_depth(Size size) {
        if (size == scene_depth_size)
            return;
        scene_depth_size = size;
        scene_depth = Texture();
        glActiveTexture(GL_TEXTURE0 + scene_depth_unit);
        glBindTexture(GL_TEXTURE_2D, scene_depth.name());
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, size.width, size.height);
        set_sampling(GL_TEXTURE_2D, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, scene_depth_target.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                               scene_depth.name(), 0);
        const GLenum none = GL_NONE;
        glDrawBuffers(1, &none);
        glReadBuffer(GL_NONE);
    }

    // Draws the opaque objects' depth alone; for shadows (without the backdrop and what is baked)
    // and for ambient occlusion.
    void draw_depth(const SceneFrame& frame, const Mat4& clip_from_room, bool with_still) {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
        glDisable(GL_CULL_FACE);
        const float farthest = 1;
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        shadow.use();
        for (const SceneObject& object : frame.objects) {
            // A depth map has no opacity: a translucent object would cast a solid one's shadow.
            if (is_translucent(object) || object.cut || (object.backdrop && !with_still) ||
                ((object.look.baked || !object.casts_shadow) && !with_still))
                continue;
            set_matrix(shadow_clip_from_object, clip_from_room * place_of(object));
            object.mesh->buffers().draw();
        }
        glBindVertexArray(0);
    }

    void make_shadow_map(int side) {
        if (side == shadow_side)
            return;
        shadow_side = side;
        shadow_map = Texture();
        glActiveTexture(GL_TEXTURE0 + shadow_unit);
        glBindTexture(GL_TEXTURE_2D, shadow_map.name());
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, side, side);
        set_sampling(GL_TEXTURE_2D, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
        glBindFramebuffer(GL_FRAMEBUFFER, shadow_target.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                               shadow_map.name(), 0);
        const GLenum none = GL_NONE;
        glDrawBuffers(1, &none);
        glReadBuffer(GL_NONE);
    }

    void begin_lit(const DrawTarget& target) {
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glViewport(target.x, target.y, target.size.width, target.size.height);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glActiveTexture(GL_TEXTURE0 + shadow_unit);
        glBindTexture(GL_TEXTURE_2D, shadow_map.name());
        glActiveTexture(GL_TEXTURE0 + environment_unit);
        glBindTexture(GL_TEXTURE_CUBE_MAP, environment.name());
        in_use = nullptr;
        baked_in_use = false;
    }

    // Makes the right program current and sets its uniforms of the whole picture.
    void use_lit(const LitPicture& picture, Surface surface, bool cuts) {
        const SceneFrame& frame = picture.frame;
        const CameraView& view = picture.view;
        const bool high = frame.quality == SceneQuality::high;
        std::optional<LitProgram>& wanted = lit[high][int(surface)][cuts];
        if (!wanted)
            wanted.emplace(high, surface, cuts);
        if (in_use == &*wanted)
            return;
        baked_in_use = false;
        in_use = &*wanted;
        in_use->program.use();
        set_matrix(in_use->clip_from_room, projection(view) * matrix(inverse(view.room_from_eye)));
        set_matrix(in_use->light_from_room, LightView(frame).clip_from_room);
        set_vector(in_use->eye, view.room_from_eye.translation);
        set_vector(in_use->to_light, normalized(frame.to_light));
        glUniform1f(in_use->light, float(frame.light));
        glUniform1f(in_use->surroundings, float(frame.surroundings));
        glUniform1f(in_use->shadow_texel, 1.0f / float(shadow_side));
        set_depth_from_w(view, in_use->depth_from_w);
        glUniform1i(in_use->occludes, picture.occludes);
        set_spots(frame.spots);
    }

    void set_spots(const std::vector<Spotlight>& spots) const {
        const auto count = GLsizei(std::min(spots.size(), most_spots));
        glUniform1i(in_use->spot_count, count);
        std::vector<float> places, along, kinds;
        for (const Spotlight& spot : std::span(spots).first(std::size_t(count))) {
            const Vec3 p = spot.place, d = normalized(spot.target - spot.place);
            places.insert(places.end(), {float(p.x), float(p.y), float(p.z)});
            along.insert(along.end(), {float(d.x), float(d.y), float(d.z)});
            kinds.insert(kinds.end(), {float(spot.strength), float(spot.slope)});
        }
        if (count == 0)
            return;
        glUniform3fv(in_use->spot_place, count, places.data());
        glUniform3fv(in_use->spot_along, count, along.data());
        glUniform2fv(in_use->spot, count, kinds.data());
    }

    void draw_baked(const LitPicture& picture, const SceneObject& object) {
        if (!baked)
            baked.emplace();
        if (!baked_in_use) {
            const CameraView& view = picture.view;
            baked_in_use = true;
            in_use = nullptr;
            baked->program.use();
            set_matrix(baked->clip_from_room,
                       projection(view) * matrix(inverse(view.room_from_eye)));
            set_matrix(baked->light_from_room, LightView(picture.frame).clip_from_room);
        }
        set_matrix(baked->room_from_object, place_of(object));
        set_vector(baked->base_color, object.look.base_color);
        glUniform1i(baked->tells_distance, !object.backdrop);
        bind_texture(surface_unit, &texture_of(object.look).parts().texture);
        object.mesh->buffers().draw();
    }

    const SceneTexture& texture_of(const SurfaceLook& look) const {
        return look.texture ? *look.texture : white;
    }

    void draw(const LitPicture& picture, const SceneObject& object) {
        const SurfaceLook& look = object.look;
        if (look.baked)
            return draw_baked(picture, object);
        use_lit(picture,
                look.unlit     ? Surface::unlit
                : look.texture ? Surface::textured
                               : Surface::plain,
                object.cut.has_value());
        set_matrix(in_use->room_from_object, place_of(object));
        if (object.cut)
            glUniform4f(in_use->cut, float(object.cut->normal.x), float(object.cut->normal.y),
                        float(object.cut->normal.z), float(object.cut->distance_m));
        set_vector(in_use->base_color, look.base_color);
        glUniform4f(in_use->look, float(look.metallic),
                    float(std::clamp(look.roughness, 0.05, 1.0)), float(look.opacity),
                    float(look.grid_m));
        glUniform1i(in_use->tells_distance, !object.backdrop);
        bind_texture(surface_unit, &texture_of(look).parts().texture);
        object.mesh->buffers().draw();
    }
};

SceneQuality usual_quality() {
    return is_software(driver_name()) ? SceneQuality::low : SceneQuality::high;
}

BegunScenePrograms::BegunScenePrograms(SceneQuality quality)
    : programs_(std::make_unique<BegunPrograms>()) {
    const auto begin = [&](ShaderFiles vertex, ShaderFiles fragment) {
        programs_->begin(vertex, fragment);
    };
    shadow_files(begin);
    baked_files(begin);
    line_files(begin);
    for (const Surface surface : {Surface::plain, Surface::textured, Surface::unlit})
        lit_files(quality == SceneQuality::high, surface, false, begin);
}
BegunScenePrograms::~BegunScenePrograms() = default;

bool BegunScenePrograms::are_ready() const {
    return programs_->are_ready();
}

ScenePasses::ScenePasses(const FontAtlas* atlas) : parts_(std::make_unique<Parts>(atlas)) {}
ScenePasses::~ScenePasses() = default;
ScenePasses::ScenePasses(ScenePasses&&) noexcept = default;
ScenePasses& ScenePasses::operator=(ScenePasses&&) noexcept = default;

void ScenePasses::prepare(const SceneFrame& frame, const CameraView& first, Size picture) {
    Parts& p = *parts_;
    if (p.text)
        p.label.place(frame.labels, *p.text, first, picture);
    p.make_shadow_map(frame.quality == SceneQuality::high ? 2048 : 1024);
    glActiveTexture(GL_TEXTURE0 + shadow_unit);
    glBindTexture(GL_TEXTURE_2D, 0);  // a texture that is drawn into must not be read
    glBindFramebuffer(GL_FRAMEBUFFER, p.shadow_target.name());
    glViewport(0, 0, p.shadow_side, p.shadow_side);
    p.draw_depth(frame, LightView(frame).clip_from_room, false);
}

void ScenePasses::draw_opaque(const SceneFrame& frame, const CameraView& view,
                              const DrawTarget& target) {
    Parts& p = *parts_;
    const bool occludes = frame.quality == SceneQuality::high;
    if (occludes) {
        p.make_scene_depth(target.size);
        glActiveTexture(GL_TEXTURE0 + scene_depth_unit);
        glBindTexture(GL_TEXTURE_2D, 0);  // a texture that is drawn into must not be read
        glBindFramebuffer(GL_FRAMEBUFFER, p.scene_depth_target.name());
        glViewport(0, 0, target.size.width, target.size.height);
        p.draw_depth(frame, projection(view) * matrix(inverse(view.room_from_eye)), true);
        glActiveTexture(GL_TEXTURE0 + scene_depth_unit);
        glBindTexture(GL_TEXTURE_2D, p.scene_depth.name());
    }
    p.begin_lit(target);
    const LitPicture picture{frame, view, occludes};
    glDisable(GL_BLEND);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    for (const bool backdrop : {true, false}) {
        glDepthMask(backdrop ? GL_FALSE : GL_TRUE);
        for (const SceneObject& object : frame.objects)
            if (!is_translucent(object) && object.backdrop == backdrop) {
                // Through a cut the inside is seen.
                if (object.cut)
                    glDisable(GL_CULL_FACE);
                p.draw(picture, object);
                if (object.cut)
                    glEnable(GL_CULL_FACE);
            }
    }
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
}

void ScenePasses::draw_translucent(const SceneFrame& frame, const CameraView& view,
                                   const DrawTarget& target) {
    Parts& p = *parts_;
    struct Side {
        const SceneObject* object;
        GLenum hidden;
        double distance_m;
    };
    std::vector<Side> sorted;
    for (const SceneObject& object : frame.objects) {
        if (!is_translucent(object))
            continue;
        const SceneMesh::Buffers& mesh = object.mesh->buffers();
        const Vec3 middle = object.room_from_object * (mesh.middle * object.scale);
        const double distance = length(middle - view.room_from_eye.translation);
        const double radius = mesh.radius_m * object.scale;
        sorted.push_back({&object, GL_FRONT, distance + radius});
        sorted.push_back({&object, GL_BACK, distance - radius});
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Side& a, const Side& b) { return a.distance_m > b.distance_m; });
    p.begin_lit(target);
    const LitPicture picture{frame, view, false};
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_CULL_FACE);
    for (const Side& side : sorted) {
        glCullFace(side.hidden);
        p.draw(picture, *side.object);
    }
    glDisable(GL_CULL_FACE);
    p.line.draw(frame.lines, view, target);
    if (p.text) {
        p.text->draw(frame.texts, view);
        p.label.draw(frame.labels, *p.text, view, target);
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glBindVertexArray(0);
}

}  // namespace theatron::render
