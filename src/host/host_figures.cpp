// SPDX-License-Identifier: Apache-2.0
#include "host/host_figures.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/hex_text.h"
#include "host/filter_choice.h"
#include "host/whose_published.h"
#include "wire/condition_text.h"

namespace theatron::host {
namespace {

using send::DropReason;

// Every reason with its count, the receivers' one included.
std::vector<std::pair<const char*, std::uint64_t>> drops(const HostFigures::Camera& camera) {
    std::vector<std::pair<const char*, std::uint64_t>> result;
    for (int i = 0; i < send::drop_reasons; ++i)
        result.push_back({text_of(DropReason(i)), camera.lane.dropped[std::size_t(i)]});
    result.push_back({"slow_receiver", camera.dropped_slow});
    return result;
}

// Frames of depth and colour alike: the older one counts. Nothing for a participant without
// pictures, and for a recorder, which decodes none.
std::optional<double> age_ms(const HostFigures::Participant& participant) {
    std::optional<Duration> age;
    for (const wire::StreamReport& stream : participant.streams)
        if (stream.frames > 0 && stream.age > Duration(0))
            age = std::max(age.value_or(stream.age), stream.age);
    return age ? std::optional(to_ms(*age)) : std::nullopt;
}

// Negative after its end.
files::UtcSeconds seconds_left(const HostFigures& figures,
                               const HostFigures::Certificate& certificate) {
    const auto now = std::chrono::floor<std::chrono::seconds>(figures.utc);
    return certificate.ends - now.time_since_epoch().count();
}

bool is_gpu(const std::string& filter_device) {
    return !filter_device.empty() && filter_device != "cpu";
}

nlohmann::json camera_json(const HostFigures::Camera& camera) {
    const send::LaneFigures& f = camera.lane;
    nlohmann::json stages = nlohmann::json::array();
    for (const auto& stage : f.stages)
        stages.push_back(
            {{"name", stage.name},
             {"p50_ms", stage.p50_ms},
             {"p99_ms", stage.p99_ms},
             {"mean_ms", 1000 * stage.seconds.sum() /
                             double(std::max<std::uint64_t>(stage.seconds.count(), 1))}});
    nlohmann::json encoders = nlohmann::json::array();
    for (const auto& encoder : f.encoders)
        encoders.push_back({{"codec", encoder.codec},
                            {"stream", is_depth(encoder.stream) ? "depth" : "color"},
                            {"cpu_ms", encoder.cpu_ms},
                            {"behind", encoder.behind},
                            {"left_out", encoder.left_out}});
    nlohmann::json dropped;
    for (const auto& [reason, count] : drops(camera))
        dropped[reason] = count;
    nlohmann::json troubles;
    for (int i = 1; i < capture::trouble_kinds; ++i)
        troubles[capture::text_of(capture::Trouble(i))] = f.camera.figures.troubles[std::size_t(i)];
    return {{"name", f.name},
            {"state", text_of(f.camera.condition)},
            {"problem", wire::english(f.camera.problem)},
            {"trouble", capture::text_of(f.camera.trouble)},
            {"fps", f.frames_per_second},
            {"frames", f.frames},
            {"age_ms", f.age_seconds * 1000},
            {"sync_offset_ms", f.sync_offset_seconds * 1000},
            {"filter", f.filter},
            {"filter_device", f.filter_device},
            {"encoders", encoders},
            {"dropped_newest", f.dropped_newest},
            {"dropped_slow_receiver", camera.dropped_slow},
            {"dropped", dropped},
            {"troubles", troubles},
            {"reopens", f.camera.figures.reopens},
            {"lost_pictures", f.camera.lost_pictures},
            {"bytes", f.bytes},
            {"stages", stages}};
}

// Backslash, quote and line end are the only characters that a label must escape.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '\\' || c == '"')
            result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result + '"';
}

// Writes families of metrics, each with its help and type once.
class PrometheusText {
public:
    void family(const char* name, const char* type, const char* help) {
        name_ = std::string("theatron_") + name;
        text_ += "# HELP " + name_ + " " + help + "\n# TYPE " + name_ + " " + type + "\n";
    }
    void value(const std::string& labels, double value, const char* suffix = "") {
        char number[40];
        std::snprintf(number, sizeof(number), "%.10g", value);
        text_ += name_ + suffix + "{" + labels + "} " + number + "\n";
    }
    void histogram(const std::string& labels, const Histogram& h) {
        for (std::size_t i = 0; i < Histogram::bound_count; ++i) {
            char bound[40];
            std::snprintf(bound, sizeof(bound), ",le=\"%g\"", Histogram::bounds[i]);
            value(labels + bound, double(h.at_most(i)), "_bucket");
        }
        value(labels + ",le=\"+Inf\"", double(h.count()), "_bucket");
        value(labels, h.sum(), "_sum");
        value(labels, double(h.count()), "_count");
    }
    std::string take() { return std::move(text_); }

private:
    std::string name_, text_;
};

}  // namespace

nlohmann::json visitor_json(const wire::Visitor& visitor) {
    nlohmann::json json{{"id", std::uint32_t(visitor.participant)},
                        {"role", wire::text_of(visitor.role)},
                        {"records", visitor.records}};
    if (!visitor.name.empty()) {
        json["name"] = visitor.name;
        json["person"] = hex_text(visitor.person);
    }
    return json;
}

nlohmann::json skew_json(const MomentFigures& moments) {
    if (moments.whole == 0)
        return nullptr;
    return {{"p50", moments.skew_p50_ms}, {"max", moments.skew_max_ms}};
}

nlohmann::json to_json(const HostFigures& figures) {
    nlohmann::json cameras = nlohmann::json::array(), participants = nlohmann::json::array(),
                   overlaps = nlohmann::json::array();
    for (std::size_t i = 0; i < figures.cameras.size(); ++i) {
        nlohmann::json& camera = cameras.emplace_back(camera_json(figures.cameras[i]));
        camera["adjusted"] = figures.adjustment(CameraId(i));
        if (i < figures.gains.size() && figures.gains[i]) {
            const auto& [factors, is_estimated] = *figures.gains[i];
            camera["color_gain"] = {{"red", factors.x},
                                    {"green", factors.y},
                                    {"blue", factors.z},
                                    {"estimated", is_estimated}};
        }
        if (i >= figures.places.cameras.size())
            continue;
        const PlaceWatch::Figures::Camera& place = figures.places.cameras[i];
        if (camera["problem"] == "")
            camera["problem"] = wire::english(place.problem);
        if (place.has_place)
            camera["covered"] = place.is_covered;
        if (place.is_watched)
            camera["place"] = {{"moved_mm", place.moved_mm},
                               {"turned_deg", place.turned_deg},
                               {"far", place.is_far},
                               {"alarm", place.is_alarm}};
    }
    for (const auto& pair : figures.places.pairs)
        overlaps.push_back(
            {{"a", pair.a}, {"b", pair.b}, {"apart_mm", pair.apart_mm}, {"alarm", pair.is_alarm}});
    for (const auto& participant : figures.participants) {
        nlohmann::json relayed = nlohmann::json::array();
        for (const CameraId camera : participant.relayed)
            relayed.push_back(int(camera));
        participants.push_back(
            {{"id", int(participant.id)},
             {"name", participant.name},
             {"sent", participant.sent},
             {"renderer", participant.renderer},
             {"refused_requests", participant.refused},
             {"denied_messages", participant.denied},
             {"refused_pictures", participant.refused_pictures},
             {"role", wire::text_of(participant.role)},
             {"muted", participant.muted},
             {"relay",
              participant.relay ? nlohmann::json(int(*participant.relay)) : nlohmann::json()},
             {"relayed", relayed},
             {"age_ms", nullptr}});
        if (const auto age = age_ms(participant))
            participants.back()["age_ms"] = *age;
    }
    nlohmann::json published = nlohmann::json::array();
    for (const auto& camera : figures.published) {
        published.push_back({{"id", int(camera.id)},
                             {"name", camera.name},
                             {"publisher", int(camera.publisher)},
                             {"whose", whose_camera(figures, camera)},
                             {"state", wire::text_of(camera.condition)},
                             {"adjusted", figures.adjustment(camera.id)},
                             {"dropped_slow", camera.dropped_slow},
                             {"bytes", camera.bytes},
                             {"sync_offset_ms", nullptr},
                             {"filter", camera.filter},
                             {"filter_device", camera.filter_device}});
        if (camera.sync_offset_seconds)
            published.back()["sync_offset_ms"] = *camera.sync_offset_seconds * 1000;
    }
    nlohmann::json visitors = nlohmann::json::array();
    for (const auto& visitor : figures.visitors)
        visitors.push_back(visitor_json(visitor));
    nlohmann::json certificates = nlohmann::json::array();
    for (const auto& certificate : figures.certificates)
        certificates.push_back({{"of", certificate.of},
                                {"fingerprint", certificate.fingerprint},
                                {"expires", files::utc_text(certificate.ends)},
                                {"seconds_left", seconds_left(figures, certificate)},
                                {"problem", certificate.problem}});
    return {{"name", figures.name},
            {"utc", utc_text(figures.utc)},
            {"session_us", to_us(figures.session_time)},
            {"seconds", figures.seconds},
            {"automatic_color", figures.automatic_color},
            {"cameras", cameras},
            {"participants", participants},
            {"published", published},
            {"skew_ms", skew_json(figures.moments)},
            {"unpaired", figures.moments.unpaired},
            {"overlaps", overlaps},
            {"registration",
             {{"made", figures.registration.made},
              {"method", figures.registration.method},
              {"problem", figures.registration.problem}}},
            {"visitors", visitors},
            {"case_problems", figures.case_problems},
            {"past_bytes", figures.past_bytes},
            {"turned_away", figures.turned_away},
            {"offers_bbr", figures.offers_bbr},
            {"faults", figures.faults},
            {"page_problem", figures.page_problem},
            {"problems",
             {{"audit_log", figures.problems.audit_log},
              {"room", figures.problems.room},
              {"links", figures.problems.links}}},
            {"certificates", certificates}};
}

nlohmann::json to_json(const PortFigures& all) {
    nlohmann::json json = to_json(all.sessions.front());
    for (std::size_t i = 1; i < all.sessions.size(); ++i) {
        nlohmann::json session = to_json(all.sessions[i]);
        for (const char* of_host :
             {"turned_away", "offers_bbr", "faults", "page_problem", "certificates"})
            session.erase(of_host);
        json["sessions"].push_back(std::move(session));
    }
    for (const ClosedSession& session : all.closed)
        json["closed_sessions"].push_back({{"name", session.name}, {"problem", session.problem}});
    return json;
}

std::string to_prometheus(const PortFigures& figures_of_all) {
    const std::vector<HostFigures>& all = figures_of_all.sessions;
    PrometheusText out;
    using Camera = HostFigures::Camera;
    using Place = PlaceWatch::Figures::Camera;
    using Participant = HostFigures::Participant;
    // The first session's lines are those of a host with a single one.
    const auto in_session = [&](const HostFigures& figures, const std::string& labels) {
        if (&figures == &all.front())
            return labels;
        return "session=" + quoted(figures.name) + (labels.empty() ? "" : ",") + labels;
    };
    // Two cameras may have the same name; the number tells them apart.
    const auto labels = [&](const HostFigures& figures, std::size_t i) {
        return in_session(figures, "camera=\"" + std::to_string(i) +
                                       "\",name=" + quoted(figures.cameras[i].lane.name));
    };
    using Look = std::function<void(const std::string& labels, const Camera&)>;
    const auto each_camera = [&](const Look& look) {
        for (const HostFigures& figures : all)
            for (std::size_t i = 0; i < figures.cameras.size(); ++i)
                look(labels(figures, i), figures.cameras[i]);
    };
    const auto per_camera = [&](const char* name, const char* type, const char* help,
                                const std::function<double(const Camera&)>& value) {
        out.family(name, type, help);
        each_camera([&](const std::string& of, const Camera& c) { out.value(of, value(c)); });
    };
    using LookAtPublished =
        std::function<void(const std::string& labels, const HostFigures::Published&)>;
    const auto each_published = [&](const LookAtPublished& look) {
        for (const HostFigures& figures : all)
            for (const HostFigures::Published& camera : figures.published)
                if (!camera.is_face)
                    look(in_session(figures, "camera=\"" + std::to_string(int(camera.id)) +
                                                 "\",name=" + quoted(camera.name)),
                         camera);
    };
    const auto per_session = [&](const char* name, const char* help,
                                 const std::function<std::size_t(const HostFigures&)>& value) {
        out.family(name, "gauge", help);
        for (const HostFigures& figures : all)
            out.value(in_session(figures, ""), double(value(figures)));
    };
    const auto per_participant = [&](const char* name, const char* type, const char* help,
                                     const std::function<double(const Participant&)>& value) {
        out.family(name, type, help);
        for (const HostFigures& figures : all)
            for (const Participant& participant : figures.participants)
                out.value(in_session(figures,
                                     "participant=\"" + std::to_string(int(participant.id)) + "\""),
                          value(participant));
    };
    per_camera("frames_per_second", "gauge", "Good frames from the camera in the last second.",
               [](const Camera& c) { return c.lane.frames_per_second; });
    per_camera("frames_total", "counter", "Good frames from the camera.",
               [](const Camera& c) { return double(c.lane.frames); });
    out.family("frames_dropped_total", "counter", "Frames that were left out, by reason.");
    each_camera([&](const std::string& of, const Camera& c) {
        for (const auto& [reason, count] : drops(c))
            out.value(of + ",reason=\"" + reason + "\"", double(count));
    });
    out.family("stage_seconds", "histogram", "Time that a frame spent in a stage of the host.");
    each_camera([&](const std::string& of, const Camera& c) {
        for (const auto& stage : c.lane.stages)
            out.histogram(of + ",stage=\"" + stage.name + "\"", stage.seconds);
    });
    per_camera("age_seconds", "gauge", "Since the camera's newest good frame was captured.",
               [](const Camera& c) { return c.lane.age_seconds; });
    out.family("bits_total", "counter", "Encoded bits, all settings together, by kind of image.");
    each_camera([&](const std::string& of, const Camera& c) {
        out.value(of + ",kind=\"depth\"", 8.0 * double(c.lane.depth_bytes));
        out.value(of + ",kind=\"color\"", 8.0 * double(c.lane.color_bytes));
    });
    per_camera("sync_offset_seconds", "gauge",
               "From the moment that the newest frame belongs to, to its capture.",
               [](const Camera& c) { return c.lane.sync_offset_seconds; });
    out.family("published_sync_offset_seconds", "gauge",
               "The same of a camera that a participant sends.");
    each_published([&](const std::string& of, const HostFigures::Published& c) {
        if (c.sync_offset_seconds)
            out.value(of, *c.sync_offset_seconds);
    });
    out.family("skew_seconds", "gauge",
               "Between the first and the last exposure of one moment: median and largest.");
    for (const HostFigures& figures : all) {
        if (figures.moments.whole == 0)
            continue;
        out.value(in_session(figures, "quantile=\"0.5\""), figures.moments.skew_p50_ms / 1000);
        out.value(in_session(figures, "quantile=\"1\""), figures.moments.skew_max_ms / 1000);
    }
    out.family("unpaired_pictures_total", "counter",
               "Pictures of moments of which another running camera has none.");
    for (const HostFigures& figures : all)
        out.value(in_session(figures, ""), double(figures.moments.unpaired));
    per_camera("camera_stale", "gauge", "1 while the camera gives no good pictures.",
               [](const Camera& c) {
                   return c.lane.camera.condition == wire::CameraCondition::live ? 0.0 : 1.0;
               });
    per_camera("filter_on_gpu", "gauge", "1 while a GPU filters the camera's depth.",
               [](const Camera& c) { return is_gpu(c.lane.filter_device) ? 1.0 : 0.0; });
    out.family("published_filter_on_gpu", "gauge",
               "The same of a camera that a participant sends.");
    each_published([&](const std::string& of, const HostFigures::Published& c) {
        out.value(of, is_gpu(c.filter_device) ? 1 : 0);
    });
    out.family("camera_troubles_total", "counter", "How often a camera became stale, by kind.");
    each_camera([&](const std::string& of, const Camera& c) {
        for (int kind = 1; kind < capture::trouble_kinds; ++kind)
            out.value(of + ",kind=\"" + capture::text_of(capture::Trouble(kind)) + "\"",
                      double(c.lane.camera.figures.troubles[std::size_t(kind)]));
    });
    per_camera("recorded_pictures_lost_total", "counter",
               "Pictures of a damaged recording that cannot be played.",
               [](const Camera& c) { return double(c.lane.camera.lost_pictures); });
    const auto per_place = [&](const char* name, const char* help, bool Place::*has_value,
                               const std::function<double(const Place&)>& value) {
        out.family(name, "gauge", help);
        for (const HostFigures& figures : all)
            for (std::size_t i = 0; i < figures.places.cameras.size(); ++i)
                if (figures.places.cameras[i].*has_value)
                    out.value(labels(figures, i), value(figures.places.cameras[i]));
    };
    per_place("camera_moved_mm", "How far what a camera sees was displaced since the host began.",
              &Place::is_watched, [](const Place& p) { return p.moved_mm; });
    per_place("camera_moved_alarm", "1 while a camera is not where it was registered.",
              &Place::is_watched, [](const Place& p) { return p.is_alarm ? 1.0 : 0.0; });
    per_place("camera_moved_far",
              "1 while a camera was moved too far to be measured, by more than its moved_mm.",
              &Place::is_watched, [](const Place& p) { return p.is_far ? 1.0 : 0.0; });
    per_place("camera_covered", "1 while a camera is covered, so that its place is not watched.",
              &Place::has_place, [](const Place& p) { return p.is_covered ? 1.0 : 0.0; });
    out.family("overlap_apart_mm", "gauge",
               "Median distance of the surfaces that two cameras see, depth as measured "
               "less each camera's saved offset.");
    for (const HostFigures& figures : all)
        for (const auto& pair : figures.places.pairs)
            out.value(in_session(figures, "a=\"" + std::to_string(pair.a) + "\",b=\"" +
                                              std::to_string(pair.b) + "\""),
                      pair.apart_mm);
    per_camera("reopens_total", "counter", "How often the camera was opened again.",
               [](const Camera& c) { return double(c.lane.camera.figures.reopens); });

    per_session("session_open",
                "1 while a session of the host is open, 0 while it cannot be opened.",
                [](const HostFigures&) { return 1; });
    for (const ClosedSession& session : figures_of_all.closed)
        out.value("session=" + quoted(session.name), 0);
    per_session("participants", "Participants that have joined.",
                [](const HostFigures& f) { return f.participants.size(); });
    per_participant("participant_age_seconds", "gauge",
                    "Age of the oldest of a participant's newest frames when they were decoded.",
                    [none = std::numeric_limits<double>::quiet_NaN()](const Participant& p) {
                        return age_ms(p).value_or(none) / 1000;
                    });
    per_participant("requests_refused_total", "counter",
                    "Requests that came too often, by participant.",
                    [](const Participant& p) { return double(p.refused); });
    per_participant("messages_denied_total", "counter",
                    "Messages that a participant's role does not allow.",
                    [](const Participant& p) { return double(p.denied); });
    per_participant("pictures_refused_total", "counter",
                    "Pictures of a participant's face or screen that were too large or too many.",
                    [](const Participant& p) { return double(p.refused_pictures); });
    per_session("visitors", "People who wait to be let in.",
                [](const HostFigures& f) { return f.visitors.size(); });
    per_session("past_bytes", "Encoded pictures that are kept for looking back.",
                [](const HostFigures& f) { return f.past_bytes; });
    out.family("host_problem", "gauge",
               "1 while the host cannot write its audit log or a session's room, or use a link.");
    for (const HostFigures& figures : all) {
        const auto& [audit_log, room, links] = figures.problems;
        for (const auto& [of, problem] :
             {std::pair("audit_log", audit_log), {"room", room}, {"links", links}})
            out.value(in_session(figures, "of=" + quoted(of)), problem.empty() ? 0 : 1);
    }
    const HostFigures& host = all.front();
    out.family("strangers_turned_away_total", "counter",
               "Connections that showed no token in time.");
    out.value("", double(host.turned_away));
    out.family("faults_total", "counter",
               "Faults that cost a connection, a picture or a camera and not the host.");
    out.value("", double(host.faults));
    out.family("certificate_seconds_left", "gauge", "Until a certificate expires.");
    for (const auto& certificate : host.certificates)
        out.value("of=" + quoted(certificate.of), double(seconds_left(host, certificate)));
    out.family("certificate_problem", "gauge",
               "1 while a certificate must be looked after; status says why.");
    for (const auto& certificate : host.certificates)
        out.value("of=" + quoted(certificate.of), certificate.problem.empty() ? 0 : 1);
    out.family("uptime_seconds", "counter", "Since the host began.");
    out.value("", host.seconds);
    return out.take();
}

}  // namespace theatron::host
