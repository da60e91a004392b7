// SPDX-License-Identifier: Apache-2.0
#include "host/host.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/log.h"
#include "base/log_scope.h"
#include "capture/placed_camera.h"
#include "geometry/screen.h"
#include "host/codec_steps.h"
#include "host/host_identity.h"
#include "host/host_impl.h"
#include "net/content_digest.h"
#include "session/viewer_session.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::host {
namespace {

session::HostSession::CheckedCodec check_depth(const std::string& text) {
    const auto parsed = video::parse_depth_setting(text);
    return {parsed.setting.text,
            parsed.problem.empty() ? video::missing_depth_encoder(parsed.setting) : parsed.problem};
}

session::HostSession::CheckedCodec check_color(const std::string& text) {
    if (text == video::auto_color)
        return {text, ""};
    const auto parsed = video::parse_color_setting(text);
    return {parsed.setting.text,
            parsed.problem.empty() ? video::missing_color_encoder(parsed.setting) : parsed.problem};
}

// A file of places that names none of the cameras is a mistake; two cameras of one name would stand
// on each other.
// `all_there`: none of the cameras is missing, which may be one that has its place there.
void check_places(const std::string& file, const capture::CameraPlaces& places,
                  const std::vector<std::unique_ptr<capture::Camera>>& cameras, bool all_there) {
    std::set<std::string> named;
    std::string names;
    for (const auto& camera : cameras) {
        if (!camera)
            continue;
        const std::string& name = camera->info().name;
        names += (names.empty() ? "" : ", ") + name;
        if (places.find(name) && !named.insert(name).second)
            throw Error("Two cameras are called '" + name + "', so '" + file +
                        "' cannot say where each is; give one its place by hand, with place=.");
    }
    if (named.empty() && all_there)
        throw Error("'" + file + "' has no place of a camera that is opened (" + names +
                    "); register these with 'theatron register'.");
}

}  // namespace

wire::Camera describe(const capture::CameraInfo& info, bool people_are_replayed) {
    wire::Camera camera;
    camera.name = info.name;
    camera.has_color = info.calibration.color.size != Size{};
    camera.frames_per_second = info.frames_per_second;
    camera.calibration = encode_calibration(people_are_replayed ? info.calibration
                                                                : without_person(info.calibration));
    return camera;
}

void Host::Impl::open(const SessionOptions& options, const capture::Progress& progress) {
    // First, since cameras may take long to open.
    state_folder = options.state.empty() ? default_state_folder() : options.state;
    state_lock.emplace(state_folder);
    port->require_free();
    if (options.cameras.size() > wire::max_cameras)
        throw Error("A session has at most " + std::to_string(wire::max_cameras) + " cameras; " +
                    std::to_string(options.cameras.size()) + " were given.");
    played = find_played_recording(options.cameras);
    const std::vector<std::string> specifications = without_room_only(played, options.cameras);
    std::vector<std::unique_ptr<capture::Camera>> cameras;
    if (!options.places.empty())
        places = capture::load_places(options.places);
    for (std::size_t i = 0; i < specifications.size(); ++i)
        cameras.push_back(open_or_miss(i, specifications[i], progress));
    require_any(cameras);
    if (!options.places.empty())
        check_places(options.places, places, cameras, missing.empty());

    std::vector<std::string> names;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        names.push_back(cameras[i] ? cameras[i]->info().name : missing.at(i).name);
    filters = filter_sources(options.filters, names, usual_filter);
    std::vector<LoadedFilter> loaded;
    for (std::size_t i = 0; i < filters.size(); ++i) {
        loaded.push_back(filters[i].load());
        tell_missing_gpu(loaded.back().settings);
        if (cameras[i])
            check_background(loaded.back(), cameras[i]->info().calibration.depth.size);
        else
            missing.at(i).filter = loaded.back();
    }

    for (std::size_t i = 0; played && i < cameras.size(); ++i)
        if (cameras[i] && plays(*played, specifications[i])) {
            cameras[i]->follow(played->transport);
            const std::size_t number = camera_in_recording(specifications[i]);
            const Bytes& first = played->recording->cameras()[number].parts.front().calibration;
            // A camera that is placed or cropped here no longer moves as the recorded one did.
            if (const auto recorded = decode_calibration(first);
                recorded && *recorded == cameras[i]->info().calibration)
                played_cameras[CameraId(i)] = {number, &first};
        }
    const bool has_room = played && played->recording->room().present;
    room_file = std::make_unique<RoomFile>(state_folder / "room");
    port->open_certificates(state_folder);
    // Not in the folder of a further session, which is removed when that ends for good.
    recording = std::make_unique<RecordingProgram>(RecordingProgram::Options{
        options.recordings.empty() ? port->state_folder() / "recordings" : options.recordings});
    session::HostSession::Config config;
    if (!options.token.empty())
        check_token(options.token);
    asks = options.asks;
    LinkKeeper::Options keeping{state_folder, options.token, {}};
    if (options.link_lifetime > Duration(0))
        keeping.roles_expire = steady_now() + options.link_lifetime;
    // Monitoring systems need not be able to join.
    metrics_token = load_or_make_token(state_folder, "metrics.token");
    links = std::make_unique<LinkKeeper>(std::move(keeping));
    config.admission.tokens = links->tokens();
    config.admission.utc_now = files::utc_now;
    config.admission.asks = options.asks;
    if (AuditLog* log = port->open_audit())
        audit = std::make_unique<SessionAudit>(*log, in_logs);
    config.session = wire::SessionId(std::stoul(net::random_token().substr(0, 8), nullptr, 16));
    config.name = name = options.name;
    config.patient_for = options.patient_for;
    config.past.reach = options.look_back;
    config.make_secret = [] { return net::random_bytes(wire::relay_secret_size); };
    config.make_digest = net::make_content_digest;
    port->open_page();
    SavedRoom saved = room_file->load();
    config.room = std::move(saved.room);
    config.streams.adjustments = std::move(saved.adjustments);
    config.authors = std::move(saved.authors);
    config.check_depth = check_depth;
    config.check_color = check_color;
    config.admission.equal_secrets = net::equal_secrets;
    config.streams.codecs = codec_steps(color_watch.is_h264());
    const session::ViewerSession::Wishes usual;
    config.streams.usual = {check_depth(usual.depth_codec).codec,
                            check_color(usual.color_codec).codec};
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (cameras[i])
            config.cameras.push_back(
                describe(cameras[i]->info(), has_room && plays(*played, specifications[i])));
        else
            config.absent.insert(CameraId(i));

    session = std::make_unique<session::HostSession>(std::move(config));
    server = std::make_unique<SessionPort>(*port, in_port());
    port->open();
    audit_beginning();

    // Nothing is known of a missing one: it is not watched.
    std::vector<capture::CameraInfo> infos;
    double fps = 1;
    for (const auto& camera : cameras) {
        infos.push_back(camera ? camera->info() : capture::CameraInfo());
        fps = std::max(fps, infos.back().frames_per_second);
    }
    place_watch = std::make_unique<PlaceWatch>(
        infos, [this](CameraId camera, const wire::Text& problem) { take_place(camera, problem); });
    gain_watch = std::make_unique<GainWatch>(
        infos, [this](const SettledGains::Gains& gains) { take_gains(gains); });
    for (const CameraId camera : session->streams().cameras().of(session::host_publisher))
        correct_place(*session->streams().cameras().find(camera));
    moments = std::make_shared<send::SharedMoments>(fps);
    lanes.set_size(cameras.size());
    thumbnails = std::deque<Thumbnail>(cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (cameras[i])
            start_lane(i, specifications[i], std::move(cameras[i]), loaded[i]);
    for (const CameraId camera : session->streams().cameras().of(session::host_publisher))
        crop(*session->streams().cameras().find(camera));
    if (!options.cases.empty())
        cases = std::make_unique<CaseShelf>(options.cases, [this](CaseShelf::Offer offer) {
            server->post([this, offer = std::move(offer)] { take_cases(offer); });
        });
    server->begin();
    start_searches();
    if (has_room)
        start_replay();
}

void Host::Impl::start_replay() {
    replay = std::make_unique<RoomReplay>(
        *played,
        [this, camera = played->camera] {
            const send::CameraLane* lane = lanes.find(camera);
            return !lane || lane->figures().frames > 0;
        },
        [this](RoomReplay::Change change) {
            server->post([this, change = std::move(change)] { replay_room(change); });
        },
        [this](std::vector<RoomReplay::Speech> speech) {
            server->post([this, speech = std::move(speech)] { replay_voices(speech); });
        });
}

void Host::Impl::start_lane(std::size_t i, const std::string& specification,
                            std::unique_ptr<capture::Camera> camera, const LoadedFilter& filter) {
    send::CameraLane::Events events;
    events.media = [this](send::EncodedMedia encoded) { take_media(std::move(encoded)); };
    events.state = [this](wire::CameraState state) { take_camera_state(std::move(state)); };
    events.keeps_up = [this, number = CameraId(i)](SettingId setting, bool keeps_up, Duration cpu) {
        server->post([this, number, setting, keeps_up, cpu] {
            session->on_encoding(number, setting, keeps_up, to_ms(cpu));
            carry_out();
        });
    };
    events.frame = [this, i](const FramePtr& frame) {
        place_watch->offer(i, frame);
        gain_watch->offer(i, frame);
        thumbnails[i].on_frame(frame, steady_now());
    };
    send::CameraLane::Options lane;
    lane.cameras = lanes.size();
    lane.open_again = [this, specification] {
        return capture::open_camera_at(specification, places);
    };
    lane.make_color =
        color_watch.make_color({.frames_per_second = camera->info().frames_per_second,
                                .may_be_smaller = !is_screen(camera->info().calibration)});
    lane.moments = moments;
    lane.one_per_moment = true;
    auto started = std::make_unique<send::CameraLane>(
        CameraId(i), std::move(camera), std::move(events), port->workers(), std::move(lane));
    started->set_filter(filter.settings, filter.background);
    lanes.put(i, std::move(started));
}

Host::Host(const HostOptions& options, const capture::Progress& progress)
    : impl_(std::make_unique<Impl>(participants_)) {
    impl_->port = std::make_shared<HostPort>(options);
    impl_->open(options, progress);
}

Host::Host(const SessionOptions& options, const Host& first, const capture::Progress& progress)
    : impl_(std::make_unique<Impl>(participants_)) {
    impl_->port = first.impl_->port;
    impl_->in_logs = options.name;
    const log::SessionScope scope(impl_->in_logs);
    impl_->open(options, progress);
}

Host::~Host() = default;

std::string Host::link(wire::Role role) const {
    net::Link link = impl_->port->link();
    link.token = impl_->token_of(role);
    link.role = wire::text_of(role);
    return net::format_link(link);
}

void Host::set_closed(std::vector<ClosedSession> closed) {
    impl_->port->set_closed(std::move(closed));
}

void Host::end_by_host() {
    impl_->ends_by_host = true;
    impl_->farewell = wire::TextCode::ended_by_operator;
}

void Host::end_for_now() {
    impl_->farewell = wire::TextCode::host_may_return;
}

void Host::note_deleted(const std::string& session) {
    if (AuditLog* log = impl_->port->open_audit())
        log->add(deletion_of(session), "", session);
}

std::uint16_t Host::port() const {
    return impl_->port->number();
}

std::vector<std::string> Host::camera_names() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < impl_->lanes.size(); ++i)
        names.push_back(impl_->camera_name(i));
    return names;
}

std::vector<std::string> Host::unregistered_cameras() const {
    std::vector<std::string> names;
    for (const send::CameraLane* lane : impl_->lanes.all())
        if (!lane->info().calibration.registered && !is_screen(lane->info().calibration))
            names.push_back(lane->info().name);
    return names;
}

void Host::set_region(std::size_t camera, codec::strata::Region region) {
    namespace strata = codec::strata;
    send::CameraLane* lane = impl_->lanes.find(camera);
    if (!lane)
        throw Error("The camera '" + impl_->camera_name(camera) +
                    "' is missing; draw its region when it is there.");
    if (!strata::is_valid(region))
        throw Error("A region has at most " + std::to_string(strata::max_polygons) + " parts.");
    const Size size = lane->info().calibration.depth.size;
    for (const strata::Polygon& polygon : region)
        if (std::none_of(polygon.begin(), polygon.end(), [&](const strata::Corner& c) {
                return c.x < size.width && c.y < size.height;
            }))
            throw Error("The region lies outside the depth image of camera '" + lane->info().name +
                        "', which has " + std::to_string(size.width) + "x" +
                        std::to_string(size.height) + " pixels.");
    const bool is_drawn = !region.empty();
    lane->set_region(std::move(region));
    impl_->server->post([impl = impl_.get(), camera, is_drawn] {
        if (is_drawn)
            impl->with_region.insert(camera);
        else
            impl->with_region.erase(camera);
        impl->session->on_region(!impl->with_region.empty());
        impl->carry_out();
    });
}

void Host::set_renderer(const std::string& who, const wire::SetRenderer& word) {
    std::optional<ParticipantId> id;
    bool named = false;
    std::string present;
    for (const auto& participant : impl_->figures().participants) {
        const std::string number = std::to_string(int(participant.id));
        if (who == number)
            id = participant.id;
        named = named || who == participant.name;
        present += (present.empty() ? "" : ", ") + number + " " + participant.name;
    }
    if (!who.empty() && !id && !named)
        throw Error("There is no participant '" + who + "'; " +
                    (present.empty() ? "nobody has joined." : "here are " + present + "."));
    impl_->server->post([impl = impl_.get(), who, id, word] {
        if (id)
            impl->session->set_renderer(*id, word);
        else if (who.empty())
            impl->session->set_renderer(word);
        else
            impl->session->set_renderer(who, word);
        impl->carry_out();
    });
}

void Host::follow_filter_files() {
    for (std::size_t i = 0; i < impl_->filters.size(); ++i) {
        try {
            const auto changed = impl_->filters[i].changed();
            if (!changed)
                continue;
            tell_missing_gpu(changed->settings);
            // A camera that is found is missing until it has its lane.
            const std::lock_guard lock(impl_->missing_mutex);
            if (send::CameraLane* lane = impl_->lanes.find(i)) {
                check_background(*changed, lane->info().calibration.depth.size);
                lane->set_filter(changed->settings, changed->background);
            } else {
                impl_->missing.at(i).filter = *changed;
            }
            log::info("host", "filter changed",
                      {{"camera", int(i)}, {"filter", changed->settings.spelling()}});
        } catch (const Error& e) {
            log::warning("host", "filter stays as it was",
                         {{"camera", int(i)}, {"problem", e.what()}});
        }
    }
}

HostFigures Host::figures() const {
    return impl_->figures();
}

std::string Host::status_line() const {
    std::string line = std::to_string(participants()) + " participant(s)";
    for (const send::CameraLane* lane : impl_->lanes.all()) {
        const send::LaneFigures f = lane->figures();
        char text[160];
        std::snprintf(text, sizeof(text), "  %s %.1f fps", f.name.c_str(), f.frames_per_second);
        line += text;
    }
    return line;
}

void Host::follow_certificates() {
    impl_->port->follow_certificates();
}

std::string Host::room_problem() const {
    return impl_->room_file->problem();
}

}  // namespace theatron::host
