// SPDX-License-Identifier: Apache-2.0
#include "host.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "codec_steps.h"
#include "filter_choice.h"
#include "host_http.h"
#include "net/certificate.h"
#include "net/server.h"
#include "session/host_session.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::app {
namespace {

std::filesystem::path default_state_folder() {
    if (const char* set = std::getenv("XDG_STATE_HOME"); set && *set)
        return std::filesystem::path(set) / "theatron";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home ? home : "/tmp") / ".local/state/theatron";
}

// The token outlives the host, so that participants find back after a restart.
std::string load_or_make_token(const std::filesystem::path& folder, const char* name) {
    const auto path = folder / name;
    std::string token;
    std::ifstream(path) >> token;
    if (!token.empty())
        return token;
    token = net::random_token();
    std::ofstream out(path);
    out << token << "\n";
    out.close();
    if (!out)
        throw Error("Cannot write " + path.string() +
                    "; make its folder writable or name another with --state.");
    std::filesystem::permissions(
        path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return token;
}

// Where others reach a host that listens everywhere: its first outside address.
std::string outside_address() {
    ifaddrs* all = nullptr;
    if (getifaddrs(&all) != 0)
        return "127.0.0.1";
    std::string found = "127.0.0.1";
    for (const ifaddrs* i = all; i; i = i->ifa_next) {
        if (!i->ifa_addr || i->ifa_addr->sa_family != AF_INET || (i->ifa_flags & IFF_LOOPBACK) ||
            !(i->ifa_flags & IFF_UP))
            continue;
        char text[INET_ADDRSTRLEN];
        const auto* address = reinterpret_cast<const sockaddr_in*>(i->ifa_addr);
        if (inet_ntop(AF_INET, &address->sin_addr, text, sizeof(text)))
            found = text;
        break;
    }
    freeifaddrs(all);
    return found;
}

// Of cameras that are given none.
constexpr const char* usual_filter = "default";

// Cameras whose place in the room nobody knows stand side by side, so far apart
// that none stands in another's picture.
constexpr double unregistered_distance_m = 12;

session::HostSession::CheckedCodec check_depth(const std::string& text) {
    const auto parsed = video::parse_depth_setting(text);
    return {parsed.setting.text,
            parsed.problem.empty() ? video::missing_depth_encoder(parsed.setting) : parsed.problem};
}

session::HostSession::CheckedCodec check_color(const std::string& text) {
    const auto parsed = video::parse_color_setting(text);
    return {parsed.setting.text,
            parsed.problem.empty() ? video::missing_color_encoder(parsed.setting) : parsed.problem};
}

}  // namespace

struct Host::Impl {
    std::atomic<std::size_t>& participants;
    net::Certificate certificate;
    net::Link link;
    std::unique_ptr<session::HostSession> session;
    std::unique_ptr<net::Server> server;
    send::Workers workers;
    std::vector<std::unique_ptr<send::CameraLane>> lanes;
    std::vector<FilterSource> filters;  // by camera; used by who owns the host
    std::thread thread;
    // Which cameras have a region of interest; server's thread.
    std::set<std::size_t> with_region;
    std::set<std::size_t> held;  // lanes; server's thread
    // Frames given up per camera because a receiver was too slow; server's thread.
    std::map<CameraId, std::uint64_t> dropped_slow;
    mutable std::mutex figures_mutex;
    std::vector<HostFigures::Participant> participant_figures;
    std::map<CameraId, std::uint64_t> dropped_slow_figures;
    std::string name;
    std::vector<std::string> http_tokens;
    const TimePoint begun = steady_now();

    explicit Impl(std::atomic<std::size_t>& count) : participants(count) {}
    ~Impl() {
        // The server's thread uses the lanes: it ends first.
        if (server)
            server->stop();
        if (thread.joinable())
            thread.join();
        lanes.clear();
    }

    void open(const HostOptions& options, const capture::Progress& progress);
    wire::Camera describe(CameraId id, const capture::CameraInfo& info) const;
    net::Server::Handler handler();
    void start_lanes(const std::vector<std::string>& specifications,
                     std::vector<std::unique_ptr<capture::Camera>> cameras);

    // All below on the server's thread.
    void carry_out();
    void change_settings();
    void hold_lane(std::size_t camera);
    void hold_lanes();
    void distribute(const send::EncodedMedia& media);
    void measure_links();
    void note_participants();

    // From any thread.
    HostFigures figures() const;
};

void Host::Impl::open(const HostOptions& options, const capture::Progress& progress) {
    if (options.cameras.empty())
        throw Error(
            "A host needs a camera; give one with --camera, for example --camera folder:DIR.");
    std::vector<std::unique_ptr<capture::Camera>> cameras;
    for (const std::string& specification : options.cameras)
        cameras.push_back(capture::open_camera(specification, progress));

    std::vector<std::string> names;
    for (const auto& camera : cameras)
        names.push_back(camera->info().name);
    filters = filter_sources(options.filters, names, usual_filter);
    std::vector<LoadedFilter> loaded;
    for (FilterSource& source : filters)
        loaded.push_back(source.load());

    const auto state = options.state.empty() ? default_state_folder() : options.state;
    certificate = net::load_or_make_certificate(state);
    session::HostSession::Config config;
    config.token = options.token.empty() ? load_or_make_token(state, "join.token") : options.token;
    // Monitoring systems need not be able to join.
    http_tokens = {config.token, load_or_make_token(state, "metrics.token")};
    config.name = name = options.name;
    config.check_depth = check_depth;
    config.check_color = check_color;
    config.equal_secrets = net::equal_secrets;
    config.steps = codec_steps();
    for (std::size_t i = 0; i < cameras.size(); ++i)
        config.cameras.push_back(describe(CameraId(i), cameras[i]->info()));

    link = {options.link_host, 0, config.token, certificate.fingerprint};
    session = std::make_unique<session::HostSession>(std::move(config));
    server = std::make_unique<net::Server>(options.listen, certificate, handler());
    link.port = server->port();
    const bool everywhere = options.listen.address == "0.0.0.0" || options.listen.address == "::";
    if (link.host.empty())
        link.host = everywhere ? outside_address() : options.listen.address;

    // The lanes never change once the server's thread runs.
    start_lanes(options.cameras, std::move(cameras));
    for (std::size_t i = 0; i < lanes.size(); ++i)
        lanes[i]->set_filter(loaded[i].settings, loaded[i].background);
    thread = std::thread([this] {
        name_this_thread("net");
        server->run();
    });
}

wire::Camera Host::Impl::describe(CameraId id, const capture::CameraInfo& info) const {
    Calibration calibration = info.calibration;
    if (!calibration.registered)
        calibration.room_from_camera.translation.x += int(id) * unregistered_distance_m;
    wire::Camera camera;
    camera.id = id;
    camera.name = info.name;
    camera.depth_stream = depth_stream(id);
    camera.color_stream = color_stream(id);
    camera.has_color = calibration.color.size != Size{};
    camera.frames_per_second = info.frames_per_second;
    camera.calibration = encode_calibration(calibration);
    return camera;
}

net::Server::Handler Host::Impl::handler() {
    net::Server::Handler h;
    h.connected = [this](net::PeerId peer, const std::string& address) {
        log::info("host", "connection", {{"id", int(peer)}, {"address", address}});
        session->on_connected(ParticipantId(std::uint32_t(peer)), steady_now());
        carry_out();
    };
    h.control = [this](net::PeerId peer, ByteView bytes) {
        session->on_control(ParticipantId(std::uint32_t(peer)), bytes, steady_now());
        carry_out();
    };
    // Participants do not publish yet; what they send is not asked for.
    h.media = [this](net::PeerId peer, ByteView) {
        server->close(peer, "media was not asked for");
    };
    h.closed = [this](net::PeerId peer, const std::string& why) {
        log::info("host", "participant left", {{"id", int(peer)}, {"why", why}});
        session->on_closed(ParticipantId(std::uint32_t(peer)));
        carry_out();
    };
    h.now = steady_now;
    h.tick = [this] {
        measure_links();
        hold_lanes();
        session->on_tick(steady_now());
        carry_out();
        note_participants();
    };
    h.http = [this](const net::HttpRequest& request) {
        return answer_http(request, http_tokens, [this] { return figures(); });
    };
    return h;
}

void Host::Impl::start_lanes(const std::vector<std::string>& specifications,
                             std::vector<std::unique_ptr<capture::Camera>> cameras) {
    double fps = 1;
    for (const auto& camera : cameras)
        fps = std::max(fps, camera->info().frames_per_second);
    const auto moments = std::make_shared<send::SharedMoments>(fps);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        send::CameraLane::Events events;
        events.media = [this](send::EncodedMedia media) {
            server->post([this, media = std::move(media)] { distribute(media); });
        };
        events.state = [this](wire::CameraState state) {
            server->post([this, state = std::move(state)] {
                using Condition = wire::CameraCondition;
                if (state.condition == Condition::failed)
                    log::error("host", "camera failed",
                               {{"camera", int(state.camera)}, {"problem", state.problem}});
                else if (state.condition == Condition::stale)
                    log::warning("host", "camera is stale",
                                 {{"camera", int(state.camera)}, {"problem", state.problem}});
                else if (state.condition == Condition::live)
                    log::info("host", "camera is live", {{"camera", int(state.camera)}});
                session->on_camera(state);
                carry_out();
            });
        };
        send::CameraLane::Options lane;
        lane.open_again = [specification = specifications[i]] {
            return capture::open_camera(specification);
        };
        lane.moments = moments;
        lane.one_per_moment = true;
        lanes.push_back(std::make_unique<send::CameraLane>(
            CameraId(i), std::move(cameras[i]), std::move(events), workers, std::move(lane)));
    }
}

void Host::Impl::carry_out() {
    for (const auto& action : session->take_actions()) {
        const net::PeerId peer{std::uint32_t(action.participant)};
        using Kind = session::HostSession::Action::Kind;
        switch (action.kind) {
            case Kind::send:
                server->send_control(peer, wire::encode_control(action.message));
                break;
            case Kind::close:
                log::warning("host", "participant refused",
                             {{"id", int(peer)}, {"why", action.why}});
                server->close(peer, action.why);
                break;
            case Kind::joined:
                log::info("host", "participant joined", {{"id", int(peer)}, {"name", action.why}});
                break;
            case Kind::request_key: {
                const auto camera = std::size_t(camera_of(action.key.stream));
                if (camera < lanes.size())
                    lanes[camera]->request_key(action.key.stream, action.key.setting);
                break;
            }
            case Kind::change_settings:
                change_settings();
                break;
            case Kind::acknowledged:
                server->acknowledge(peer, action.bytes);
                if (!held.empty())
                    hold_lanes();
                break;
            case Kind::set_ceiling:
                server->set_ceiling(peer, double(action.bytes));
                break;
            case Kind::stepped:
                log::info("host", "sending changed", {{"id", int(peer)}, {"to", action.why}});
                break;
            case Kind::drawing:
                log::info("host", "participant draws",
                          {{"id", int(peer)}, {"renderer", action.why}});
                break;
        }
    }
}

void Host::Impl::change_settings() {
    const auto convert = [](const std::vector<session::ActiveSetting>& settings) {
        std::vector<send::LaneSetting> result;
        for (const auto& s : settings)
            result.push_back({s.id, s.codec});
        return result;
    };
    for (const auto& lane : lanes)
        lane->set_settings(convert(session->depth_settings()), convert(session->color_settings()));
    hold_lanes();
}

// While every receiver of a camera still waits for its last frame, the next is not even
// begun: dropped after encoding, it would be missing as a reference.
void Host::Impl::hold_lane(std::size_t camera) {
    bool any = false, all_behind = true;
    for (const auto& [id, participant] : session->participants()) {
        if (!participant.takes_part())
            continue;
        const net::PeerId peer{std::uint32_t(id)};
        any = true;
        all_behind &= !participant.delivery.adapts() &&
                      (server->is_behind(peer, depth_stream(CameraId(camera))) ||
                       server->is_behind(peer, color_stream(CameraId(camera))));
    }
    const bool hold = any && all_behind;
    if (hold == held.contains(camera))
        return;
    if (hold)
        held.insert(camera);
    else
        held.erase(camera);
    lanes[camera]->hold(hold);
}

void Host::Impl::hold_lanes() {
    for (std::size_t camera = 0; camera < lanes.size(); ++camera)
        hold_lane(camera);
}

void Host::Impl::distribute(const send::EncodedMedia& encoded) {
    const wire::MediaHeader& header = encoded.header;
    net::Media media{encoded.message,  header.stream,         header.setting, header.frame,
                     header.reference, header.temporal_layer, header.key,     {}};
    for (const ParticipantId receiver :
         session->on_media(header, encoded.message->size(), steady_now())) {
        const auto pushed = server->send_media(net::PeerId(std::uint32_t(receiver)), media);
        dropped_slow[camera_of(header.stream)] += std::uint64_t(pushed.dropped);
        if (pushed.needs_key)
            session->on_broken_stream(header.stream, header.setting);
    }
    hold_lane(std::size_t(camera_of(header.stream)));
}

void Host::Impl::measure_links() {
    for (const auto& [id, participant] : session->participants()) {
        const auto f = server->take_figures(net::PeerId(std::uint32_t(id)));
        session->on_link(id, {f.bytes_per_second, f.round_trip, f.delay, f.dropped}, steady_now());
    }
}

void Host::Impl::note_participants() {
    std::vector<HostFigures::Participant> list;
    for (const auto& [id, participant] : session->participants())
        if (participant.joined)
            list.push_back({id, participant.name, participant.delivery.step().what,
                            participant.report, participant.renderer});
    participants = list.size();
    const std::lock_guard lock(figures_mutex);
    participant_figures = std::move(list);
    dropped_slow_figures = dropped_slow;
}

HostFigures Host::Impl::figures() const {
    const std::lock_guard lock(figures_mutex);
    HostFigures figures;
    figures.name = name;
    figures.seconds = to_seconds(steady_now() - begun);
    for (const auto& lane : lanes) {
        const auto dropped = dropped_slow_figures.find(lane->id());
        figures.cameras.push_back(
            {lane->figures(), dropped == dropped_slow_figures.end() ? 0 : dropped->second});
    }
    figures.participants = participant_figures;
    return figures;
}

Host::Host(const HostOptions& options, const capture::Progress& progress)
    : impl_(std::make_unique<Impl>(participants_)) {
    impl_->open(options, progress);
}

Host::~Host() = default;

std::string Host::link() const {
    return net::format_link(impl_->link);
}

std::uint16_t Host::port() const {
    return impl_->link.port;
}

std::vector<std::string> Host::camera_names() const {
    std::vector<std::string> names;
    for (const auto& lane : impl_->lanes)
        names.push_back(lane->info().name);
    return names;
}

void Host::set_region(std::size_t camera, codec::strata::Region region) {
    namespace strata = codec::strata;
    const auto& lane = impl_->lanes.at(camera);
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
            impl_->lanes[i]->set_filter(changed->settings, changed->background);
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
    for (const auto& lane : impl_->lanes) {
        const send::LaneFigures f = lane->figures();
        char text[160];
        std::snprintf(text, sizeof(text), "  %s %.1f fps", f.name.c_str(), f.frames_per_second);
        line += text;
    }
    return line;
}

}  // namespace theatron::app
