// SPDX-License-Identifier: Apache-2.0
#include "compare_measure.h"

#include <algorithm>
#include <ctime>
#include <thread>

#include "base/error.h"
#include "base/statistics.h"
#include "bench_libjpeg.h"
#include "camera_frames.h"
#include "compare_causes.h"
#include "compare_close_up.h"
#include "compare_pcl.h"
#include "compare_points.h"
#include "filter/chain.h"
#include "filter/color_registration.h"
#include "render/cloud_set.h"
#include "render/gl_driver.h"
#include "render/offscreen_context_native.h"
#include "render/picture_quality.h"
#include "svg_drawing.h"
#include "this_machine.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::bench {
namespace {

constexpr Duration between_pictures = Duration(33'333);
// Pictures that a renderer with a memory gets before the one that is compared.
constexpr std::size_t drawn_before = 5;
// A usual rate of video calls for a picture of this size.
constexpr double call_mbit = 2.5;

// Processor time of all threads of this process.
double processor_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

template <class Work>
double processor_ms_of(const Work& work) {
    const double begin = processor_ms();
    work();
    return processor_ms() - begin;
}

// One camera's pictures on their way.
struct CameraStream {
    std::vector<double> bytes, sender_ms, receiver_ms;
    void add(std::size_t picture_bytes, double sent_ms, double received_ms) {
        bytes.push_back(double(picture_bytes));
        sender_ms.push_back(sent_ms);
        receiver_ms.push_back(received_ms);
    }
};

// All but the first one, which no other precedes, unless it is the only one.
std::vector<double> later(const std::vector<double>& values) {
    return values.size() > 1 ? std::vector<double>(values.begin() + 1, values.end()) : values;
}

void add_costs(CompareMethod& method, const std::vector<CameraStream>& streams,
               const std::vector<CompareLink>& links) {
    std::vector<SentMoment> moments(streams.front().bytes.size());
    std::vector<double> sender, receiver;
    double bytes = 0, pictures = 0;
    for (const CameraStream& stream : streams) {
        for (std::size_t i = 0; i < moments.size(); ++i) {
            moments[i].bytes += std::size_t(stream.bytes[i]);
            moments[i].sender_ms = std::max(moments[i].sender_ms, stream.sender_ms[i]);
            moments[i].receiver_ms = std::max(moments[i].receiver_ms, stream.receiver_ms[i]);
        }
        for (const double b : later(stream.bytes)) {
            bytes += b;
            ++pictures;
        }
        for (const double ms : later(stream.sender_ms))
            sender.push_back(ms);
        for (const double ms : later(stream.receiver_ms))
            receiver.push_back(ms);
    }
    method.cameras = int(streams.size());
    method.mbit_per_camera = bytes / pictures * 8 * compare_pictures_per_s / 1e6;
    method.sender_ms = median(sender);
    method.receiver_ms = median(receiver);
    for (const CompareLink& link : links)
        method.links.push_back(sent_over(link, moments, compare_pictures_per_s));
}

// An encoder and a decoder of colour.
class ColorWay {
public:
    ColorWay(std::unique_ptr<video::ColorEncoder> encoder,
             std::unique_ptr<video::ColorDecoder> decoder)
        : encoder_(std::move(encoder)), decoder_(std::move(decoder)) {}

    // The bytes are valid until the next call.
    ByteView encode(const ColorData& color) {
        const auto encoded = encoder_->encode(color, number_ == 0);
        if (!encoded)
            throw Error("A picture of the generated room could not be compressed.");
        return encoded->bytes;
    }
    ColorImage decode(ByteView bytes) {
        if (decoder_->submit(bytes, FrameNumber(number_++)) == Status::ok)
            if (auto decoded = decoder_->poll())
                return std::move(decoded->image);
        throw Error("A picture of the generated room did not come back.");
    }

private:
    std::unique_ptr<video::ColorEncoder> encoder_;
    std::unique_ptr<video::ColorDecoder> decoder_;
    unsigned number_ = 0;
};

ColorWay color_way(const std::string& codec) {
    const video::ColorSetting setting = video::parse_color_setting(codec).setting;
    return {video::make_color_encoder(setting), video::make_color_decoder(setting.id)};
}

class DepthWay {
public:
    explicit DepthWay(const std::string& codec)
        : encoder_(video::make_depth_encoder(video::parse_depth_setting(codec).setting)),
          decoder_(video::make_depth_decoder(video::parse_depth_setting(codec).setting)) {}

    std::size_t encode(DepthView depth) {
        bytes_.resize(encoder_.max_encoded_size(depth.size));
        encoded_ = encoder_.encode(depth, FrameNumber(number_), number_ == 0, bytes_);
        ++number_;
        return encoded_.bytes;
    }
    DepthImage decode(Size size) {
        DepthImage depth(size);
        if (decoder_.decode(encoded_, ByteView(bytes_).first(encoded_.bytes), depth.view()) !=
            Status::ok)
            throw Error("Depth of the generated room did not come back.");
        return depth;
    }

private:
    codec::DepthStreamEncoder encoder_;
    codec::DepthStreamDecoder decoder_;
    Bytes bytes_;
    codec::EncodedDepth encoded_;
    unsigned number_ = 0;
};

filter::Chain filters_of(const std::string& chain, const Calibration& calibration) {
    return {filter::parse_chain(chain).settings,
            {.size = calibration.depth.size, .depth_unit_mm = calibration.depth_unit_mm}};
}

// Depth with the colour of each of its pixels, as in programs that send points: depth without
// colour is left out.
class RegisteredImages {
public:
    RegisteredImages(const Calibration& calibration, const std::string& chain)
        : filters_(filters_of(chain, calibration)),
          registration_(calibration),
          jpeg_(video::make_color_decoder(video::ColorCodecId::jpeg)),
          seen(calibration.depth.size) {
        color.size = calibration.depth.size;
        color.pixels.resize(color.size);
    }

    void take(const DepthImage& measured, const ColorData& picture) {
        if (jpeg_->submit(picture.jpeg, 0) != Status::ok)
            throw Error("A picture of the generated room is damaged.");
        auto decoded = jpeg_->poll();
        depth = copy_of(filters_.apply(measured.view(), between_pictures));
        registration_.apply(depth.view(), decoded->image.view(), color.pixels.view(), seen.view());
        jpeg_->recycle(std::move(decoded->image));
        for (std::size_t i = 0; i < seen.pixels.size(); ++i)
            if (seen.pixels[i] == 0)
                depth.pixels[i] = 0;
    }

private:
    filter::Chain filters_;
    filter::ColorRegistration registration_;
    std::unique_ptr<video::ColorDecoder> jpeg_;

public:
    DepthImage depth;
    ColorData color;
    Image<std::uint8_t> seen;
};

// The last images of one camera that a viewer has.
struct ArrivedCamera {
    Calibration calibration;
    std::vector<DepthImage> depth;
    std::vector<ColorImage> color;
};

// Pixels in which something is drawn.
Image<std::uint8_t> drawn_mask(DepthView drawn_mm) {
    Image<std::uint8_t> mask(drawn_mm.size);
    for (int y = 0; y < mask.size.height; ++y)
        for (int x = 0; x < mask.size.width; ++x)
            mask.view().row(y)[x] = drawn_mm.row(y)[x] != 0;
    return mask;
}

CompareOwnView own_view_of(const ColorImage& exact, const ColorImage& arrived) {
    Image<std::uint8_t> all(exact.size);
    std::fill(all.pixels.begin(), all.pixels.end(), 255);
    render::SquaredError error;
    render::Similarity similarity;
    error.add(arrived.view(), exact.view(), all.view());
    similarity.add(arrived.view(), exact.view(), all.view());
    return {error.psnr_db(), similarity.mean()};
}

// Sums the differences of drawn pictures from the exact ones.
class LikenessSum {
public:
    void add(const render::Picture& drawn, const ViewBenchPlace& place) {
        error_.add(drawn.color.view(), place.exact_color.view(), place.seen.view());
        similarity_.add(drawn.color.view(), place.exact_color.view(), place.seen.view());
        holes_.add(drawn.depth_mm.view(), place.exact_mm.view(), place.seen.view());
        const Image<std::uint8_t> is_drawn = drawn_mask(drawn.depth_mm.view());
        for (std::size_t i = 0; i < is_drawn.pixels.size(); ++i) {
            undrawn_ += !is_drawn.pixels[i];
            undrawn_unseen_ += !is_drawn.pixels[i] && !place.seen.pixels[i];
        }
        pixels_ += double(is_drawn.pixels.size());
        see_through_.add(drawn.depth_mm.view(), place.exact_mm.view(), is_drawn.view());
    }
    CompareLikeness result() const {
        return {.psnr_db = error_.psnr_db(),
                .ssim = similarity_.mean(),
                .holes_percent = holes_.percent(),
                .undrawn_percent = 100 * undrawn_ / pixels_,
                .undrawn_unseen_percent = 100 * undrawn_unseen_ / pixels_,
                .see_through_percent = see_through_.percent()};
    }

private:
    render::SquaredError error_;
    render::Similarity similarity_;
    render::Holes holes_, see_through_;
    double undrawn_ = 0, undrawn_unseen_ = 0, pixels_ = 0;
};

class CompareMeasuring {
public:
    CompareMeasuring(const CompareOptions& options, const capture::Progress& progress)
        : options_(options), progress_(progress) {}

    Compared run() {
        out_.processor = processor_name();
        out_.cores = int(std::thread::hardware_concurrency());
        out_.cameras = options_.scene.cameras;
        out_.frames = options_.scene.frames;
        out_.picture = options_.scene.picture;
        out_.links = options_.links;
        out_.cores_of_others = cores_of_others();
        scene_ = make_compare_scene(options_.scene, progress_);
        out_.depth = scene_.cameras.front().calibration.depth.size;
        out_.color = scene_.cameras.front().color.front().size;
        out_.places = scene_.place_names;
        for (const ViewBenchPlace& place : scene_.without_near.places)
            out_.truth.push_back(place.exact_color);
        out_.close_up_truth = scene_.without_near.close_up.exact_color;
        out_.close_up_width_m = close_up_width_m;
        begin_drawing();
        step("measuring a video call", [&] { return video_call(false); });
        step("measuring a video call with a zoomed camera", [&] { return video_call(true); });
        step("measuring the published pipeline", [&] { return paper(); });
        step("measuring PCL's codec", [&] { return pcl(); });
        step("measuring Theatron", [&] { return theatron(false); });
        step("measuring Theatron with a near camera", [&] { return theatron(true); });
        if (context_ && context_->errors() > 0)
            throw Error("The graphics driver reports an error: " + context_->first_error());
        return std::move(out_);
    }

private:
    void begin_drawing() {
        try {
            context_ = std::make_unique<render::OffscreenContext>();
            out_.gl_renderer = render::driver_name();
        } catch (const Error& e) {
            no_gl_ = e.what();
        }
    }

    template <class Method>
    void step(const char* what, const Method& method) {
        step_ = what;
        tell(0);
        out_.methods.push_back(method());
        tell(1);
    }
    void tell(double done) const { progress_(step_, done); }
    // After a picture of a camera; drawing comes afterwards.
    void tell_measured(std::size_t camera, std::size_t picture) const {
        constexpr double before_drawing = 0.7;
        const double pictures = double(options_.scene.frames);
        tell(before_drawing * (double(camera) + double(picture) / pictures) /
             double(scene_.cameras.size()));
    }

    // The cameras that all methods have: without the near one.
    std::size_t usual_cameras() const { return scene_.cameras.size() - 1; }

    // One picture from each place and the close-up.
    void add_pictures(CompareMethod& method, const CompareViews& views,
                      std::vector<render::Picture> drawn, render::Picture close_up,
                      const std::vector<CauseCamera>& cameras) const {
        LikenessSum all, close;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            LikenessSum one;
            one.add(drawn[i], views.places[i]);
            all.add(drawn[i], views.places[i]);
            method.from_place.push_back(one.result());
        }
        method.expert = all.result();
        for (render::Picture& picture : drawn)
            method.pictures.push_back(std::move(picture.color));
        close.add(close_up, views.close_up);
        const ViewBenchPlace& place = views.close_up;
        const Image<std::uint8_t> is_drawn = drawn_mask(close_up.depth_mm.view());
        CauseInput input{place.view, close_up.depth_mm.view(), place.exact_mm.view(),
                         place.seen.view(), is_drawn.view()};
        const CompareCauses see_through = causes_of(input, cameras);
        constexpr int behind_instruments_mm = 20;
        input.where = place.instrument.view();
        input.jump_mm = behind_instruments_mm;
        method.close_up = {std::move(close_up.color), close.result(), see_through,
                           causes_of(input, cameras)};
    }

    // The last depth images of the first cameras, beside what arrived of them.
    std::vector<CauseCamera> causes_with(const std::vector<ArrivedCamera>& arrived) const {
        std::vector<CauseCamera> cameras;
        for (std::size_t c = 0; c < arrived.size(); ++c)
            cameras.push_back({scene_.cameras[c].calibration, scene_.cameras[c].depth.back().view(),
                               arrived[c].depth.back().view()});
        return cameras;
    }

    void draw(CompareMethod& method, const CompareViews& views,
              const std::vector<ArrivedCamera>& cameras, const std::string& renderer) const {
        if (!context_) {
            method.expert_reason = no_gl_;
            return;
        }
        render::CloudSet clouds;
        for (std::size_t c = 0; c < cameras.size(); ++c)
            clouds.set_camera(CameraId(c), cameras[c].calibration);
        std::vector<render::Picture> drawn;
        for (std::size_t i = 0; i < cameras.front().depth.size(); ++i) {
            for (std::size_t c = 0; c < cameras.size(); ++c)
                if (clouds.upload(CameraId(c), cameras[c].depth[i].view(),
                                  cameras[c].color[i].view()) != Status::ok)
                    throw Error("A generated camera's images do not have its calibrated size.");
            if (i + 1 < cameras.front().depth.size())
                (void)clouds.render(views.places[0].view, options_.scene.picture, renderer);
            tell(0.7 + 0.2 * double(i) / double(cameras.front().depth.size()));
        }
        for (const ViewBenchPlace& place : views.places) {
            drawn.push_back(clouds.render(place.view, options_.scene.picture, renderer));
            tell(0.9 + 0.1 * double(drawn.size()) / double(views.places.size()));
        }
        add_pictures(method, views, std::move(drawn),
                     clouds.render(views.close_up.view, options_.scene.picture, renderer),
                     causes_with(cameras));
    }

    CompareMethod video_call(bool zoomed) const {
        CompareMethod method{
            .id = zoomed ? zoomed_call_id : video_call_id,
            .name = zoomed ? "Video call, zoomed" : "Video call",
            .plain = zoomed ? "A video call whose camera hangs at the same place and is zoomed to "
                              "the wound. It shows nothing else"
                            : "The picture of one camera, as in any video call. The expert sees "
                              "what that camera sees"};
        method.rate_setting_mbit = call_mbit;
        const std::string rate = "h264:bitrate_mbit=" + formatted("%g", call_mbit);
        const std::string x264 = rate + ",preset=veryfast,encoder=x264";
        const bool has_x264 =
            video::missing_color_encoder(video::parse_color_setting(x264).setting).empty();
        const std::string codec = has_x264 ? x264 : rate;
        method.reason = video::missing_color_encoder(video::parse_color_setting(codec).setting);
        method.ran = std::string("one camera") + (zoomed ? " zoomed to the wound, " : ", ") +
                     std::to_string(out_.color.width) + "x" + std::to_string(out_.color.height) +
                     ", H.264 set to " + formatted("%g", call_mbit) + " Mbit/s by " +
                     (has_x264 ? "FFmpeg's libx264 (veryfast)" : "OpenH264");
        method.expert_reason =
            "A video call shows what its camera sees; it has no picture from another place.";
        if (!method.reason.empty())
            return method;
        const CompareCamera& camera = scene_.cameras.front();
        ColorWay way = color_way(codec);
        CameraStream stream;
        for (const ColorData& picture : zoomed ? scene_.zoomed : camera.color) {
            ByteView bytes;
            ColorImage back;
            const double sent = processor_ms_of([&] { bytes = way.encode(picture); });
            const double received = processor_ms_of([&] { back = way.decode(bytes); });
            stream.add(bytes.size(), sent, received);
            method.pictures = {std::move(back)};
        }
        const ColorImage& shown = method.pictures.front();
        method.own_view = own_view_of(zoomed ? scene_.zoomed_exact : camera.last_exact, shown);
        if (zoomed) {
            method.close_up = {shown, {}, {}, {}};
            method.pictures.clear();
        } else if (const auto part =
                       part_around(camera.calibration, shown.size, scene_.wound, close_up_width_m))
            method.close_up = {parts_of(method.pictures, *part).front(), {}, {}, {}};
        add_costs(method, {stream}, options_.links);
        return method;
    }

    CompareMethod paper() const {
        CompareMethod method{
            .id = paper_id,
            .name = "Research system, 2022",
            .plain =
                "The method of a published study, built again from its text. Cameras that also "
                "measure distance; the expert's computer draws surfaces from them",
            .ran =
                "Fischer et al. 2022: filters of the study (\"paper\"), colour registered to depth "
                "as JPEG of "
                "quality 85 (libjpeg-turbo), depth as temporal RVL without loss, drawn as mesh"};
        std::vector<CameraStream> streams;
        std::vector<ArrivedCamera> arrived;
        const auto setting = video::parse_color_setting("jpeg:quality=85").setting;
        for (std::size_t c = 0; c < usual_cameras(); ++c) {
            const CompareCamera& camera = scene_.cameras[c];
            RegisteredImages images(camera.calibration, "paper");
            ColorWay color(make_libjpeg_encoder(setting), make_libjpeg_decoder());
            DepthWay depth("trvl");
            CameraStream& stream = streams.emplace_back();
            ArrivedCamera& end = arrived.emplace_back();
            end.calibration = camera.calibration;
            end.calibration.color = camera.calibration.depth;
            end.calibration.color_from_depth = {};
            for (std::size_t i = 0; i < camera.depth.size(); ++i) {
                ByteView color_bytes;
                std::size_t depth_bytes = 0;
                const double sent = processor_ms_of([&] {
                    images.take(camera.depth[i], camera.color[i]);
                    depth_bytes = depth.encode(images.depth.view());
                    color_bytes = color.encode(images.color);
                });
                const double received = processor_ms_of([&] {
                    end.depth = {depth.decode(images.depth.size)};
                    end.color = {color.decode(color_bytes)};
                });
                stream.add(color_bytes.size() + depth_bytes, sent, received);
                tell_measured(c, i);
            }
        }
        add_costs(method, streams, options_.links);
        draw(method, scene_.without_near, arrived, "mesh");
        return method;
    }

    CompareMethod pcl() const {
        CompareMethod method{.id = pcl_id,
                             .name = "General 3D method",
                             .plain =
                                 "Cameras that also measure distance. Their coloured points are "
                                 "compressed by a library for any purpose, and drawn as squares"};
        method.ran = "PCL's octree codec, the family that cwipc's codec comes from";
        method.reason = missing_pcl();
        if (!method.reason.empty())
            return method;
        std::vector<CameraStream> streams;
        std::vector<PointCloud> last;
        std::vector<PlacedCloud> placed;
        std::vector<ArrivedCamera> filtered;
        last.reserve(scene_.cameras.size());
        double edge_m = 0;
        for (std::size_t c = 0; c < usual_cameras(); ++c) {
            const CompareCamera& camera = scene_.cameras[c];
            RegisteredImages images(camera.calibration, "default");
            const Image<Ray> rays = make_ray_table(camera.calibration.depth);
            std::vector<PointCloud> clouds(camera.depth.size());
            std::vector<double> made_ms;
            for (std::size_t i = 0; i < clouds.size(); ++i) {
                made_ms.push_back(processor_ms_of([&] {
                    images.take(camera.depth[i], camera.color[i]);
                    clouds[i] =
                        cloud_of(camera.calibration, rays, images.depth.view(),
                                 images.color.pixels.view(), std::as_const(images.seen).view());
                }));
                tell_measured(c, i);
            }
            PclFigures figures = pcl_figures(clouds);
            CameraStream& stream = streams.emplace_back();
            for (std::size_t i = 0; i < clouds.size(); ++i)
                stream.add(std::size_t(figures.clouds[i].bytes),
                           made_ms[i] + figures.clouds[i].encode_ms, figures.clouds[i].decode_ms);
            last.push_back(std::move(figures.last));
            placed.push_back({&last.back(), camera.calibration.room_from_camera});
            filtered.push_back({camera.calibration, {std::move(images.depth)}, {}});
            // Points of a grid touch if they are as large as its cells are wide at a slant.
            edge_m = figures.resolution_m * 1.5;
            method.ran =
                "PCL " + figures.version +
                ", octree codec at medium resolution with colour (points of " +
                std::to_string(int(figures.resolution_m * 1000 + 0.5)) +
                " mm), the family that cwipc's codec comes from; usual filters (\"default\"); "
                "drawn as squares";
        }
        add_costs(method, streams, options_.links);
        std::vector<render::Picture> drawn;
        const CompareViews& views = scene_.without_near;
        for (const ViewBenchPlace& place : views.places)
            drawn.push_back(draw_points(placed, place.view, options_.scene.picture, edge_m));
        add_pictures(method, views, std::move(drawn),
                     draw_points(placed, views.close_up.view, options_.scene.picture, edge_m),
                     causes_with(filtered));
        return method;
    }

    CompareMethod theatron(bool near) const {
        CompareMethod method{
            .id = near ? theatron_near_id : theatron_id,
            .name = near ? "Theatron, near camera" : "Theatron",
            .plain = near ? "Theatron with one camera more, on an arm over the foot of the table, "
                            "about a metre from the wound, on the expert's side"
                          : "The cameras of the research system. Theatron removes noise, sends "
                            "distances in a form of its "
                            "own and colours as video, and draws surfaces from both"};
        // A host sends this to `auto`, where it has an encoder and time.
        std::string codec = "h264:crf=20";
        if (!video::missing_color_encoder(video::parse_color_setting(codec).setting).empty())
            codec = "jpeg:quality=85";
        method.ran =
            "usual filters (\"default\"), distances without loss by Theatron's codec strata, "
            "colour as " +
            codec + ", drawn by the renderer blend";
        std::vector<CameraStream> streams;
        std::vector<ArrivedCamera> arrived;
        for (std::size_t c = 0; c < usual_cameras() + std::size_t(near); ++c) {
            const CompareCamera& camera = scene_.cameras[c];
            filter::Chain filters = filters_of("default", camera.calibration);
            ColorWay color = color_way(codec);
            DepthWay depth("strata");
            CameraStream& stream = streams.emplace_back();
            ArrivedCamera& end = arrived.emplace_back();
            end.calibration = camera.calibration;
            for (std::size_t i = 0; i < camera.depth.size(); ++i) {
                ByteView color_bytes;
                std::size_t depth_bytes = 0;
                DepthImage depth_back;
                ColorImage color_back;
                const double sent = processor_ms_of([&] {
                    depth_bytes =
                        depth.encode(filters.apply(camera.depth[i].view(), between_pictures));
                    color_bytes = color.encode(camera.color[i]);
                });
                const double received = processor_ms_of([&] {
                    depth_back = depth.decode(camera.depth[i].size);
                    color_back = color.decode(color_bytes);
                });
                stream.add(color_bytes.size() + depth_bytes, sent, received);
                tell_measured(c, i);
                if (i + drawn_before < camera.depth.size())
                    continue;
                end.depth.push_back(std::move(depth_back));
                end.color.push_back(std::move(color_back));
            }
        }
        method.own_view =
            own_view_of(scene_.cameras.front().last_exact, arrived.front().color.back());
        add_costs(method, streams, options_.links);
        draw(method, near ? scene_.with_near : scene_.without_near, arrived, "blend");
        return method;
    }

    const CompareOptions& options_;
    const capture::Progress& progress_;
    CompareScene scene_;
    Compared out_;
    std::unique_ptr<render::OffscreenContext> context_;
    std::string no_gl_;
    const char* step_ = "";
};

}  // namespace

Compared measure_compare(const CompareOptions& options, const capture::Progress& progress) {
    return CompareMeasuring(options, progress).run();
}

}  // namespace theatron::bench
