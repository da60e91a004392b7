// SPDX-License-Identifier: Apache-2.0
#include "publish/camera_publisher.h"

#include <algorithm>

#include "base/log.h"
#include "base/steady_clock.h"
#include "capture/placed_camera.h"
#include "geometry/calibration.h"
#include "geometry/screen.h"
#include "publish/distinct_names.h"
#include "publish/own_camera.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::publish {
namespace {

// Depth images that are searched for a head before the guess is taken.
constexpr int images_with_a_head = 15;

// Why this build cannot encode with this codec setting; empty: it can.
std::string problem_of(bool depth, const std::string& codec) {
    if (depth) {
        const auto parsed = video::parse_depth_setting(codec);
        return parsed.problem.empty() ? video::missing_depth_encoder(parsed.setting)
                                      : parsed.problem;
    }
    if (codec == video::auto_color)
        return "";
    const auto parsed = video::parse_color_setting(codec);
    return parsed.problem.empty() ? video::missing_color_encoder(parsed.setting) : parsed.problem;
}

void shift(TimePoint& time, Duration offset) {
    if (time != TimePoint{})
        time += offset;
}

// The eyes of the person in the first depth images of this camera: of the first head in them, or
// else what the last one of them suggests.
std::optional<Vec3> eyes_before(capture::Camera& camera) {
    std::optional<Vec3> eyes;
    const TimePoint end = steady_now() + CameraPublisher::person_patience;
    int images = 0;
    for (TimePoint now = steady_now(); now < end && images < images_with_a_head;
         now = steady_now()) {
        const capture::Capture capture = camera.next(end - now);
        if (capture.kind == capture::Capture::Kind::nothing)
            continue;
        if (capture.kind != capture::Capture::Kind::frame)
            break;
        ++images;
        const auto found = find_eyes(capture.frame->depth.view(), camera.info().calibration);
        if (found)
            eyes = found->middle;
        if (found && found->of_head)
            break;
    }
    return eyes;
}

// Turns the cameras' places in the room into places before the person. Screens stay in the room.
void place_before_person(const std::vector<std::unique_ptr<capture::Camera>>& opened,
                         std::vector<Calibration>& cameras) {
    const auto first = std::find_if_not(cameras.begin(), cameras.end(), is_screen);
    if (first == cameras.end())
        return;
    const Calibration before = *first;
    const Pose person_from_first =
        person_from_camera(before, eyes_before(*opened[std::size_t(first - cameras.begin())]));
    for (Calibration& camera : cameras) {
        if (is_screen(camera))
            continue;
        const bool is_placed = before.registered && camera.registered;
        camera.room_from_camera = is_placed ? person_from_first * inverse(before.room_from_camera) *
                                                  camera.room_from_camera
                                            : person_from_first;
        camera.registered = true;
    }
}

}  // namespace

CameraPublisher::CameraPublisher(std::vector<std::string> specifications, const std::string& places,
                                 const capture::Progress& progress, const Sharing& sharing)
    : specifications_(std::move(specifications)),
      places_(places.empty() ? capture::CameraPlaces() : capture::load_places(places)),
      is_face_(sharing.kind == wire::CameraKind::face),
      states_(specifications_.size()) {
    std::vector<std::unique_ptr<capture::Camera>> cameras;
    for (const std::string& specification : specifications_)
        cameras.push_back(capture::open_camera_at(specification, places_, progress));
    open_all(std::move(cameras), sharing);
}

CameraPublisher::CameraPublisher(std::vector<std::unique_ptr<capture::Camera>> cameras,
                                 const Sharing& sharing)
    : specifications_(cameras.size()),
      is_face_(sharing.kind == wire::CameraKind::face),
      states_(specifications_.size()) {
    open_all(std::move(cameras), sharing);
}

CameraPublisher::~CameraPublisher() {
    end();
    lanes_.clear();
}

void CameraPublisher::open_all(std::vector<std::unique_ptr<capture::Camera>> cameras,
                               const Sharing& sharing) {
    std::vector<Calibration> calibrations;
    for (const auto& camera : cameras)
        calibrations.push_back(without_person(camera->info().calibration));
    if (sharing.kind == wire::CameraKind::person)
        place_before_person(cameras, calibrations);
    std::vector<std::string> names;
    for (const auto& camera : cameras)
        names.push_back(camera->info().name);
    names = distinct_names(std::move(names));
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const capture::CameraInfo& info = cameras[i]->info();
        offered_.push_back(i);
        const bool is_in_room = is_screen(calibrations[i]) && !is_face_;
        offers_.push_back({names[i], info.calibration.color.size != Size{}, info.frames_per_second,
                           encode_calibration(calibrations[i]), sharing.may_record,
                           is_in_room ? wire::CameraKind::room : sharing.kind});
    }
    double fps = 1;
    for (const auto& camera : cameras)
        fps = std::max(fps, camera->info().frames_per_second);
    moments_ = std::make_shared<send::SharedMoments>(fps);
    for (std::size_t i = 0; i < cameras.size(); ++i)
        open(i, std::move(cameras[i]));
}

void CameraPublisher::open(std::size_t camera, std::unique_ptr<capture::Camera> opened) {
    send::CameraLane::Events events;
    events.media = [this, camera](const send::EncodedMedia& encoded) { on_media(camera, encoded); };
    events.state = [this, camera](wire::CameraState state) { on_state(camera, std::move(state)); };
    send::CameraLane::Options options;
    options.cameras = specifications_.size();
    options.moments = moments_;
    std::string specification = specifications_[camera];
    // A live screen keeps its size: a window may have another one when it comes back.
    const capture::CameraInfo& info = opened->info();
    const Size size = info.calibration.color.size;
    if (info.live && is_screen(info.calibration) && !is_face_ && !specification.empty() &&
        specification.find(",size=") == std::string::npos)
        specification += ",size=" + std::to_string(size.width) + "x" + std::to_string(size.height);
    if (!specification.empty())
        options.open_again = [this, specification] {
            return capture::open_camera_at(specification, places_);
        };
    options.make_color =
        color_watch_.make_color({.frames_per_second = info.frames_per_second,
                                 .may_be_smaller = !is_face_ && !is_screen(info.calibration)});
    // Lanes number cameras from 0; on_media() writes the host's numbers into the headers.
    lanes_.push_back(std::make_unique<send::CameraLane>(
        CameraId(camera), std::move(opened), std::move(events), workers_, std::move(options)));
}

std::vector<std::string> CameraPublisher::camera_names() const {
    std::vector<std::string> names;
    for (const wire::OfferedCamera& offer : offers_)
        names.push_back(offer.name);
    return names;
}

std::vector<CameraPublisher::Figures> CameraPublisher::figures() const {
    std::vector<Figures> result;
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        result.push_back({std::nullopt, true, lanes_[i]->figures()});
        result.back().lane.name = offers_[i].name;
    }
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < offered_.size(); ++i) {
        Figures& figures = result[offered_[i]];
        figures.has_ended = false;
        if (i < numbers_.size())
            figures.number = numbers_[i];
    }
    return result;
}

bool CameraPublisher::has_ended() const {
    const std::lock_guard lock(mutex_);
    return offered_.empty();
}

client::Participant::Publishing CameraPublisher::events() {
    client::Participant::Publishing events;
    events.published = [this](const std::vector<CameraId>& numbers) { on_published(numbers); };
    events.ended = [this](const std::vector<CameraId>& numbers) { on_ended(numbers); };
    events.encode = [this](const std::vector<wire::StreamSetting>& settings) {
        on_encode(settings);
    };
    events.encode_key = [this](StreamId stream, SettingId setting) {
        on_encode_key(stream, setting);
    };
    return events;
}

void CameraPublisher::begin(client::Participant& participant) {
    std::vector<wire::OfferedCamera> offers;
    {
        const std::lock_guard lock(mutex_);
        participant_ = &participant;
        for (const std::size_t camera : offered_)
            offers.push_back(offers_[camera]);
    }
    if (is_face_ && !offers.empty())
        participant.publish_face(offers.front());
    else
        participant.publish(std::move(offers));
}

void CameraPublisher::end() {
    const std::lock_guard lock(mutex_);
    if (participant_ && is_face_)
        participant_->publish_face(std::nullopt);
    else if (participant_)
        participant_->publish({});
    participant_ = nullptr;
    numbers_.clear();
    for (const auto& lane : lanes_)
        lane->set_settings({}, {});
}

// The index of the camera with this number of the host; lanes_.size() if there is none.
std::size_t CameraPublisher::camera_with(CameraId number) const {
    const auto found = std::find(numbers_.begin(), numbers_.end(), number);
    return found == numbers_.end() ? lanes_.size()
                                   : offered_[std::size_t(found - numbers_.begin())];
}

// The host's number of this camera; none while it is not in the session.
std::optional<CameraId> CameraPublisher::number_of(std::size_t camera) const {
    const auto found = std::find(offered_.begin(), offered_.end(), camera);
    const auto offer = std::size_t(found - offered_.begin());
    return offer < numbers_.size() ? std::optional(numbers_[offer]) : std::nullopt;
}

void CameraPublisher::on_ended(const std::vector<CameraId>& numbers) {
    const std::lock_guard lock(mutex_);
    for (const CameraId number : numbers) {
        const auto found = std::find(numbers_.begin(), numbers_.end(), number);
        if (found == numbers_.end())
            continue;
        const auto offer = found - numbers_.begin();
        lanes_[offered_[std::size_t(offer)]]->set_settings({}, {});
        offered_.erase(offered_.begin() + offer);
        numbers_.erase(found);
    }
}

void CameraPublisher::on_published(const std::vector<CameraId>& numbers) {
    const std::lock_guard lock(mutex_);
    if (!participant_)
        return;
    numbers_ = numbers;
    numbers_.resize(std::min(numbers_.size(), offered_.size()));
    if (numbers_.empty())
        for (const auto& lane : lanes_)
            lane->set_settings({}, {});
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        wire::CameraState state = states_[offered_[i]];
        state.camera = numbers_[i];
        if (state.condition != wire::CameraCondition::live || !state.problem.empty() ||
            !state.filter.empty())
            participant_->tell_camera(state);
    }
}

void CameraPublisher::on_encode(const std::vector<wire::StreamSetting>& settings) {
    const std::lock_guard lock(mutex_);
    std::vector<std::vector<send::LaneSetting>> depth(lanes_.size()), color(lanes_.size());
    for (const wire::StreamSetting& setting : settings) {
        const std::size_t camera = camera_with(camera_of(setting.stream));
        if (camera == lanes_.size())
            continue;
        const bool is_depth = theatron::is_depth(setting.stream);
        if (const std::string problem = problem_of(is_depth, setting.codec); !problem.empty()) {
            log::warning("publish", "cannot encode as the host asks",
                         {log::outside("codec", setting.codec), {"problem", problem}});
            continue;
        }
        (is_depth ? depth : color)[camera].push_back({setting.setting, setting.codec});
    }
    for (std::size_t i = 0; i < lanes_.size(); ++i)
        lanes_[i]->set_settings(std::move(depth[i]), std::move(color[i]));
}

void CameraPublisher::on_encode_key(StreamId stream, SettingId setting) {
    const std::lock_guard lock(mutex_);
    const std::size_t camera = camera_with(camera_of(stream));
    if (camera < lanes_.size())
        lanes_[camera]->request_key(
            is_depth(stream) ? depth_stream(CameraId(camera)) : color_stream(CameraId(camera)),
            setting);
}

// Writes the host's number of the camera and session times into the header, then sends.
void CameraPublisher::on_media(std::size_t camera, const send::EncodedMedia& encoded) {
    const std::lock_guard lock(mutex_);
    const auto number = number_of(camera);
    if (!participant_ || !number)
        return;
    std::vector<const send::CameraLane*> lanes;
    for (const auto& lane : lanes_)
        lanes.push_back(lane.get());
    color_watch_.on_tick(lanes, steady_now());
    const Duration offset = participant_->now() - steady_now();
    wire::MediaHeader header = encoded.header;
    header.stream = is_depth(header.stream) ? depth_stream(*number) : color_stream(*number);
    for (TimePoint* time : {&header.captured, &header.delivered, &header.filtered, &header.encoded})
        shift(*time, offset);
    header.moment = told_moment(header.moment, offset);
    const auto message = std::make_shared<Bytes>(*encoded.message);
    wire::write_media_header(header, message->data());
    participant_->send_media(header, message);
}

TimePoint CameraPublisher::told_moment(TimePoint moment, Duration offset) {
    constexpr std::size_t remembered = 64;
    const TimePoint told = told_moments_.try_emplace(moment, moment + offset).first->second;
    if (told_moments_.size() > remembered)
        told_moments_.erase(told_moments_.begin());
    return told;
}

void CameraPublisher::on_state(std::size_t camera, wire::CameraState state) {
    const std::lock_guard lock(mutex_);
    states_[camera] = state;
    const auto number = number_of(camera);
    if (!participant_ || !number)
        return;
    state.camera = *number;
    participant_->tell_camera(state);
}

}  // namespace theatron::publish
