// SPDX-License-Identifier: Apache-2.0
#include "compare_drawing_times.h"

#include <chrono>
#include <utility>

#include "base/error.h"
#include "base/statistics.h"
#include "render/complete_framebuffer.h"
#include "render/gl.h"
#include "render/picture_texture.h"
#include "render/render_target.h"

namespace theatron::bench {
namespace {

constexpr int timed_pictures = 7;

// One framebuffer to read a camera's picture from and one to scale it into.
class ScaledPictures {
public:
    ScaledPictures(std::size_t count, Size size)
        : textures_(count), size_(size), scaled_(render::make_texture(GL_RGBA8, size, GL_LINEAR)) {
        glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, scaled_.name(),
                               0);
        if (!render::is_complete_framebuffer<ScaledPictures>())
            throw Error("The graphics driver cannot draw the pictures of a video call.");
    }

    void draw(const std::vector<ArrivedCamera>& arrived) {
        const int count = int(textures_.size());
        for (int i = 0; i < count; ++i) {
            render::PictureTexture& texture = textures_[std::size_t(i)];
            texture.set(arrived[std::size_t(i)].color.back().view());
            glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.name());
            glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                                   texture.texture().name(), 0);
            glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_.name());
            glBlitFramebuffer(0, 0, texture.size().width, texture.size().height,
                              i * size_.width / count, 0, (i + 1) * size_.width / count,
                              size_.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
        }
    }

private:
    std::vector<render::PictureTexture> textures_;
    Size size_;
    render::Texture scaled_;
    render::Framebuffer source_, target_;
};

}  // namespace

double drawing_ms_of(const std::function<void()>& draw) {
    std::vector<double> ms;
    for (int i = 0; i < timed_pictures; ++i) {
        const auto start = std::chrono::steady_clock::now();
        draw();
        ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count());
    }
    return median(std::move(ms));
}

double drawing_ms_of_clouds(render::CloudSet& clouds, const std::vector<ArrivedCamera>& arrived,
                            const render::CameraView& view, Size size,
                            const std::string& renderer) {
    const render::RenderTarget target(size);
    return drawing_ms_of([&] {
        for (std::size_t c = 0; c < arrived.size(); ++c)
            if (clouds.upload(CameraId(c), arrived[c].depth.back().view(),
                              arrived[c].color.back().view()) != Status::ok)
                throw Error("A generated camera's images do not have its calibrated size.");
        target.clear(render::cloud_background);
        clouds.draw(view, target.target(), renderer);
        glFinish();
    });
}

double drawing_ms_of_video(const std::vector<ArrivedCamera>& arrived, Size size) {
    ScaledPictures pictures(arrived.size(), size);
    pictures.draw(arrived);  // allocates
    return drawing_ms_of([&] {
        pictures.draw(arrived);
        glFinish();
    });
}

}  // namespace theatron::bench
