// SPDX-License-Identifier: Apache-2.0
// Metal-rough surfaces under one lamp and the light from all around. GGX with Smith's shadowing
// (Walter et al. 2007) and Schlick's Fresnel term; for the surroundings Karis' fit of the
// environment term (2014). With LOW_QUALITY surfaces are matt, shadows have hard edges, and corners are as bright
// as the rest.

uniform samplerCube environment;  // level: roughness; the last one is diffuse
uniform sampler2DShadow shadow_map;
uniform mat4 light_from_room;
uniform vec3 eye, to_light, base_color;
uniform vec4 look;  // metallic, roughness, opacity, distance of the grid's lines
uniform bool tells_distance;
uniform float light, surroundings;
uniform float shadow_texel;
#ifdef TEXTURED
uniform sampler2D surface_texture;  // sRGB; white where the surface has none
#endif

#ifdef CUT
uniform vec4 cut;  // normal and distance of the plane behind which nothing is drawn
#endif

// Ambient occlusion, by what the opaque objects' depth shows around a place.
uniform bool occludes;
uniform sampler2D scene_depth;
uniform mat4 clip_from_room;
uniform vec2 depth_from_w;  // window depth of distance w: x + y / w

in vec3 v_place;
in vec3 v_normal;
#ifdef TEXTURED
in vec2 v_uv;
#endif
#if defined(LOW_QUALITY) && !defined(UNLIT)
in vec3 v_around;
in float v_lamp;
#endif

const float last_level = 4.0;

float lit_share(vec3 normal) {
    vec4 place = light_from_room * vec4(v_place + 0.008 * normal, 1.0);
    vec3 seen = place.xyz * 0.5 + 0.5;
    if (any(lessThan(seen, vec3(0.0))) || any(greaterThan(seen, vec3(1.0))))
        return 1.0;
    seen.z -= 0.001;
#ifdef LOW_QUALITY
    return texture(shadow_map, seen);
#else
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += texture(shadow_map, vec3(seen.xy + vec2(x, y) * shadow_texel, seen.z));
    return sum / 9.0;
#endif
}

// Faint lines on a surface, look.w metres apart; they vanish where they would be finer than the
// picture's pixels.
float line_share(vec3 n) {
    if (look.w == 0.0)
        return 0.0;
    vec3 p = v_place / look.w;
    vec3 to_line = abs(fract(p + 0.5) - 0.5), wide = fwidth(p);
    vec3 on_line = clamp(1.0 - (to_line - 0.006 / look.w) / max(wide, vec3(1e-5)), 0.0, 1.0) *
                   clamp(0.05 / max(wide, vec3(1e-5)), 0.0, 1.0);
    // Lines cross a surface, they do not lie in it.
    on_line *= step(abs(n), vec3(0.5));
    return max(on_line.x, max(on_line.y, on_line.z));
}

#ifndef LOW_QUALITY
uniform int spot_count;
uniform vec3 spot_place[2], spot_along[2];
uniform vec2 spot[2];  // strength, slope of the lit cone

// `d`: towards the lamp, of this strength.
vec3 from_lamp(vec3 d, float strength, vec3 n, vec3 v, vec3 diffuse, vec3 mirror, float roughness) {
    vec3 h = normalize(v + d);
    float nl = max(dot(n, d), 0.0), nv = max(dot(n, v), 1e-3), nh = max(dot(n, h), 0.0);
    float a2 = roughness * roughness * roughness * roughness;
    float width = nh * nh * (a2 - 1.0) + 1.0;
    float spread = a2 / (3.14159 * width * width);
    float hidden = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2) + 1e-5);
    vec3 fresnel = mirror + (1.0 - mirror) * pow(1.0 - max(dot(v, h), 0.0), 5.0);
    return (diffuse / 3.14159 + fresnel * spread * hidden) * nl * strength;
}

vec3 from_spots(vec3 n, vec3 v, vec3 diffuse, vec3 mirror, float roughness) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < spot_count; ++i) {
        vec3 to_spot = spot_place[i] - v_place;
        float ahead = -dot(to_spot, spot_along[i]);
        float beside = length(to_spot + spot_along[i] * ahead);
        float beam = ahead > 0.0 ? 1.0 - smoothstep(0.43 * spot[i].y, spot[i].y, beside / ahead) : 0.0;
        if (beam > 0.0)
            sum += from_lamp(normalize(to_spot), spot[i].x * beam / max(dot(to_spot, to_spot), 0.25), n, v, diffuse,
                             mirror, roughness);
    }
    return sum;
}

vec3 from_surroundings(vec3 n, vec3 v, vec3 diffuse, vec3 mirror, float roughness) {
    float nv = max(dot(n, v), 0.0);
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 fit = vec2(-1.04, 1.04) * a + r.zw;
    vec3 reflected = textureLod(environment, reflect(-v, n), roughness * (last_level - 1.0)).rgb;
    return surroundings * (diffuse * textureLod(environment, n, last_level).rgb +
                           reflected * (mirror * fit.x + fit.y));
}
#endif

// From light to sRGB, bright parts compressed.
vec3 shown(vec3 c) {
    c = c * (1.0 + c / 6.0) / (1.0 + c);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

#ifndef LOW_QUALITY
// True if the place lies behind the surface that the eye sees in its direction, but not far behind.
// Far behind, the two belong to different objects, and the nearer one takes no light away.
bool is_hidden(vec3 place, float reach) {
    vec4 clip = clip_from_room * vec4(place, 1.0);
    float seen = texture(scene_depth, 0.5 + 0.5 * clip.xy / clip.w).r;
    float behind = clip.w - depth_from_w.y / (seen - depth_from_w.x);
    return behind > 0.01 && behind < 2.0 * reach;
}

// The share of the light from all around that reaches the place. Along each direction two places
// are tested, because one alone misses walls that stand near.
float open_share(vec3 n) {
    if (!occludes)
        return 1.0;
    const int count = 16;
    const float reach = 0.4;  // metres
    vec3 side = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
    vec3 other = cross(n, side);
    // Each pixel turns its samples by another angle.
    float noise = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
    float hidden = 0.0;
    for (int i = 0; i < count; ++i) {
        float a = (float(i) + 0.5) / float(count), angle = 6.2832 * noise + 2.39996 * float(i);
        vec3 d = n * sqrt(1.0 - a) + (side * cos(angle) + other * sin(angle)) * sqrt(a);
        // Not in step with the angle.
        float far = reach * (0.5 + 0.5 * fract(0.7549 * float(i) + 7.0 * noise));
        vec3 from = v_place + 0.01 * n;
        hidden += float(is_hidden(from + 0.3 * far * d, reach) || is_hidden(from + far * d, reach));
    }
    // A little stronger than geometry says: what hides the light is dark itself.
    return pow(1.0 - hidden / float(count), 1.6);
}
#endif

void main() {
#ifdef CUT
    if (dot(cut.xyz, v_place) > cut.w)
        discard;
#endif
    float distance_m = tells_distance ? 1.0 / gl_FragCoord.w : 0.0;
#ifdef TEXTURED
    vec4 texel = texture(surface_texture, v_uv);
#endif
#ifdef UNLIT
    write_surface(texel.rgb * base_color, distance_m);
    out_color.a = look.z < 1.0 ? look.z * texel.a : 1.0;
#else
#ifdef TEXTURED
    vec3 material = base_color * pow(texel.rgb, vec3(2.2));
#else
    vec3 material = base_color;
#endif
    vec3 n = normalize(gl_FrontFacing ? v_normal : -v_normal);
    vec3 surface = material * (1.0 - 0.25 * line_share(n));
    vec3 v = normalize(eye - v_place);
#ifdef LOW_QUALITY
    vec3 color = surface * (v_lamp * lit_share(n) + v_around);
#else
    vec3 diffuse = surface * (1.0 - look.x);
    vec3 mirror = mix(vec3(0.04), surface, look.x);
    vec3 color = from_lamp(to_light, light, n, v, diffuse, mirror, look.y) * lit_share(n) +
                 from_spots(n, v, diffuse, mirror, look.y) +
                 from_surroundings(n, v, diffuse, mirror, look.y) * open_share(n);
#endif
    write_surface(shown(color), distance_m);
    // A thin wall seen along itself lets less light through.
    out_color.a = look.z < 1.0 ? 1.0 - pow(1.0 - look.z, 1.0 / max(dot(n, v), 0.2)) : 1.0;
#ifdef TEXTURED
    if (look.z < 1.0)
        out_color.a *= texel.a;
#endif
#endif
}
