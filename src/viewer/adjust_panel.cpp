// SPDX-License-Identifier: Apache-2.0
#include "viewer/adjust_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "geometry/screen.h"
#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

using session::CameraAdjustment;

constexpr std::size_t max_undo = 200;
constexpr int part_count = 6;

double& part_of(CameraAdjustment& adjustment, int part) {
    Vec3& vec = part < 3 ? adjustment.moved_m : adjustment.turned_deg;
    return part % 3 == 0 ? vec.x : part % 3 == 1 ? vec.y : vec.z;
}

Vec3 within(Vec3 vec, double longest) {
    const double size = length(vec);
    return size > longest ? vec * (longest / size) : vec;
}

std::string value_text(CameraAdjustment adjustment, int part) {
    constexpr Phrase names[part_count] = {Phrase::right_x, Phrase::up_y,   Phrase::back_z,
                                          Phrase::tilt_x,  Phrase::turn_y, Phrase::roll_z};
    char text[64];
    if (part < 3)
        std::snprintf(text, sizeof(text), " %+.0f mm", part_of(adjustment, part) * 1000);
    else
        std::snprintf(text, sizeof(text), " %+.1f°", part_of(adjustment, part));
    return say(names[part]) + text;
}

}  // namespace

void AdjustPanel::take(const std::vector<client::Participant::Camera>& cameras) {
    cameras_.clear();
    for (const auto& camera : cameras) {
        const wire::Camera& description = camera.description;
        const auto adjustment = session::decode_adjustment(description.adjustment);
        if (description.kind != wire::CameraKind::room || camera.calibration.person != 0 ||
            is_screen(camera.calibration) || !adjustment)
            continue;
        cameras_.push_back({description.id, description.name, *adjustment,
                            description.publisher == ParticipantId{}});
        if (const auto wanted = wanted_.find(description.id);
            wanted != wanted_.end() && session::rounded(wanted->second) == *adjustment)
            wanted_.erase(wanted);
    }
    if (!chosen() && !cameras_.empty())
        chosen_ = cameras_.front().id;
}

const AdjustPanel::Camera* AdjustPanel::chosen() const {
    const auto found = std::find_if(cameras_.begin(), cameras_.end(),
                                    [&](const Camera& camera) { return camera.id == chosen_; });
    return found == cameras_.end() ? nullptr : &*found;
}

CameraAdjustment AdjustPanel::current(const Camera& camera) const {
    const auto wanted = wanted_.find(camera.id);
    return wanted == wanted_.end() ? camera.adjustment : wanted->second;
}

void AdjustPanel::note_undo() {
    const Camera* camera = chosen();
    if (!camera)
        return;
    undo_.emplace_back(camera->id, current(*camera));
    if (undo_.size() > max_undo)
        undo_.erase(undo_.begin());
}

void AdjustPanel::want(CameraAdjustment adjustment) {
    adjustment.moved_m = within(adjustment.moved_m, CameraAdjustment::max_moved_m);
    adjustment.turned_deg = within(adjustment.turned_deg, CameraAdjustment::max_turned_deg);
    wanted_[*chosen_] = adjustment;
    sent_.erase(*chosen_);
}

void AdjustPanel::carry_out(const AdjustStep& step) {
    using What = AdjustStep::What;
    if (step.what == What::choose)
        chosen_ = step.camera;
    const Camera* camera = chosen();
    if (!camera)
        return;
    CameraAdjustment adjustment = current(*camera);
    switch (step.what) {
        case What::choose:
            return;
        case What::step:
            note_undo();
            part_of(adjustment, step.part) += step.by;
            return want(adjustment);
        case What::slide:
            note_undo();
            sliding_ = step.part;
            return;
        case What::undo:
            if (undo_.empty())
                return;
            chosen_ = undo_.back().first;
            want(undo_.back().second);
            undo_.pop_back();
            return;
        case What::reset:
            note_undo();
            adjustment.moved_m = adjustment.turned_deg = {};
            return want(adjustment);
        case What::draw:
            draws_ = !draws_;
            drawn_.reset();
            return;
        case What::whole:
            note_undo();
            adjustment.region.reset();
            return want(adjustment);
    }
}

void AdjustPanel::slide(double value) {
    const Camera* camera = chosen();
    if (!camera)
        return;
    CameraAdjustment adjustment = current(*camera);
    part_of(adjustment, sliding_) = value;
    want(adjustment);
}

void AdjustPanel::nudge(window::Nudge nudge, double yaw) {
    const Camera* camera = chosen();
    if (!camera)
        return;
    note_undo();
    CameraAdjustment adjustment = current(*camera);
    const Vec3 right{std::cos(yaw), 0, -std::sin(yaw)}, back{std::sin(yaw), 0, std::cos(yaw)};
    const auto move = [&](Vec3 way) { adjustment.moved_m = adjustment.moved_m + step_m * way; };
    using window::Nudge;
    switch (nudge) {
        case Nudge::left:
            move(-right);
            break;
        case Nudge::right:
            move(right);
            break;
        case Nudge::up:
            move({0, 1, 0});
            break;
        case Nudge::down:
            move({0, -1, 0});
            break;
        case Nudge::nearer:
            move(back);
            break;
        case Nudge::farther:
            move(-back);
            break;
        case Nudge::turn_left:
            adjustment.turned_deg.y += step_deg;
            break;
        case Nudge::turn_right:
            adjustment.turned_deg.y -= step_deg;
            break;
    }
    want(adjustment);
}

std::string AdjustPanel::draw(window::WindowInput& input, const render::CameraView& view,
                              const std::vector<CloudCamera>& cloud) {
    if (!draws_)
        return "";
    if (input.grabbed && input.grabbed_left) {
        drawn_ = ViewRectangle{*input.grabbed, *input.grabbed};
        input.grabbed.reset();
    }
    if (!drawn_)
        return "";
    if (input.pointer)
        drawn_->to = *input.pointer;
    input.steering.turn = {};
    if (!input.released)
        return "";
    const ViewRectangle rectangle = *std::exchange(drawn_, std::nullopt);
    const Camera* camera = chosen();
    const auto seen = std::find_if(cloud.begin(), cloud.end(), [&](const CloudCamera& c) {
        return camera && CameraId(c.number) == camera->id;
    });
    if (seen == cloud.end())
        return say(Phrase::camera_has_no_picture);
    const auto box = drawn_region(rectangle, view, *seen);
    if (!box)
        return say(Phrase::sees_too_little, camera->name);
    draws_ = false;
    note_undo();
    CameraAdjustment adjustment = current(*camera);
    adjustment.region = box;
    want(adjustment);
    return say(Phrase::region_is_sent, camera->name);
}

std::optional<std::pair<Vec2, Vec2>> AdjustPanel::rectangle() const {
    if (!drawn_)
        return std::nullopt;
    return std::pair(drawn_->from, drawn_->to);
}

void AdjustPanel::on_tick(client::Participant& participant, TimePoint now) {
    if (now - sent_at_ < send_every)
        return;
    for (const auto& [camera, adjustment] : wanted_) {
        if (const auto sent = sent_.find(camera); sent != sent_.end() && sent->second == adjustment)
            continue;
        if (participant.adjust(camera, adjustment) == 0)
            return give_up();
        sent_[camera] = adjustment;
        sent_at_ = now;
        return;
    }
}

void AdjustPanel::add_panel(RoomPanel& panel) const {
    window::Panel shown{say(Phrase::place_of_cameras), {}};
    const auto command = [&](AdjustStep step) { return panel.add(step); };
    using What = AdjustStep::What;
    for (const Camera& camera : cameras_) {
        const CameraAdjustment adjustment = current(camera);
        const bool is_chosen = camera.id == chosen_;
        window::PanelRow row{camera.name, text_of(adjustment), {}};
        if (!is_chosen)
            row.buttons.push_back({say(Phrase::choose), command({What::choose, camera.id, 0, 0})});
        shown.rows.push_back(std::move(row));
        for (int part = 0; is_chosen && part < part_count; ++part) {
            CameraAdjustment value = adjustment;
            const double most =
                part < 3 ? CameraAdjustment::max_moved_m : CameraAdjustment::max_turned_deg;
            const double by = part < 3 ? step_m : step_deg;
            shown.rows.push_back({value_text(adjustment, part),
                                  "",
                                  {{"-", command({What::step, {}, part, -by})},
                                   {"+", command({What::step, {}, part, by})}},
                                  window::PanelSlider{part_of(value, part), -most, most,
                                                      command({What::slide, {}, part, 0})}});
        }
        if (is_chosen)
            shown.rows.push_back({"",
                                  "",
                                  {{say(Phrase::undo), command({What::undo, {}, 0, 0})},
                                   {say(Phrase::reset_camera), command({What::reset, {}, 0, 0})}}});
        if (is_chosen && camera.has_region) {
            window::PanelRow region{say(draws_              ? Phrase::draw_rectangle
                                        : adjustment.region ? Phrase::a_region
                                                            : Phrase::whole_picture),
                                    "",
                                    {{say(draws_ ? Phrase::stop : Phrase::draw_region),
                                      command({What::draw, {}, 0, 0})}}};
            if (adjustment.region)
                region.buttons.push_back(
                    {say(Phrase::whole_picture), command({What::whole, {}, 0, 0})});
            shown.rows.push_back(std::move(region));
        }
    }
    if (cameras_.empty())
        shown.rows.push_back({say(Phrase::no_room_cameras), "", {}});
    panel.panels.push_back(std::move(shown));
}

}  // namespace theatron::viewer
