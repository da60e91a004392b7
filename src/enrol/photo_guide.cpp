// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_guide.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace theatron::enrol {

PhotoGuide::PhotoGuide(std::vector<Photo> photos, const Usual& usual, bool has_camera)
    : usual_(usual), has_camera_(has_camera), photos_(std::move(photos)) {
    begin();
}

PhotoGuide PhotoGuide::from_camera(const Usual& usual) {
    std::vector<Photo> photos;
    for (const face::Emotion emotion : photo_order)
        photos.push_back({emotion, {}, {}});
    return {std::move(photos), usual, true};
}

PhotoGuide PhotoGuide::of_photos(std::vector<Photo> photos, const Usual& usual) {
    return {std::move(photos), usual, false};
}

// The photo whose turn it is.
void PhotoGuide::begin() {
    ++turn_;
    draft_.reset();
    dragged_ = chosen_ = std::nullopt;
    cross_px_.reset();
    search_ = Search::none;
    asks_finish_ = false;
    if (index_ >= photos_.size()) {
        step_ = Step::done;
        return;
    }
    Photo& photo = photos_[index_];
    if (photo.picture.empty()) {
        step_ = Step::look;
        return;
    }
    draft_.emplace(usual_[std::size_t(photo.emotion)]);
    step_ = photo.landmarks_px ? Step::mark : Step::find;
    if (photo.landmarks_px)
        on_found(photo.landmarks_px, Search::given);
}

void PhotoGuide::next() {
    ++index_;
    begin();
}

int PhotoGuide::seconds_left(TimePoint now) const {
    return std::max(0, int(std::ceil(to_seconds(photo_at_ - now))));
}

bool PhotoGuide::can_leave_out() const {
    return step_ != Step::done && photo().emotion != face::Emotion::neutral &&
           (has_camera_ || photos_[0].landmarks_px.has_value());
}

bool PhotoGuide::can_finish() const {
    return has_camera_ && step_ != Step::done && photos_[0].landmarks_px.has_value();
}

std::optional<face::LandmarkFault> PhotoGuide::fault() const {
    const auto landmarks = step_ == Step::mark ? draft_->landmarks_px() : std::nullopt;
    if (!landmarks)
        return std::nullopt;
    return face::landmark_fault(*landmarks, usual_[std::size_t(emotion())], photo().picture.size);
}

bool PhotoGuide::can_go_on() const {
    return step_ == Step::mark && draft_->landmarks_px() && !fault();
}

bool PhotoGuide::can_go_back() const {
    return index_ > 0 && step_ != Step::done && step_ != Step::count;
}

std::vector<face::Emotion> PhotoGuide::missing() const {
    std::vector<face::Emotion> none;
    for (std::size_t i = 0; i < photos_.size(); ++i)
        if (!photos_[i].landmarks_px && !(i == index_ && can_go_on()))
            none.push_back(photos_[i].emotion);
    return none;
}

std::optional<Vec2> PhotoGuide::cross_px() const {
    return step_ == Step::mark && draft_->next() ? cross_px_ : std::nullopt;
}

void PhotoGuide::take_photo(TimePoint now) {
    if (step_ != Step::look)
        return;
    photo_at_ = now + count_down;
    step_ = Step::count;
}

void PhotoGuide::stop_counting() {
    if (step_ == Step::count)
        step_ = Step::look;
}

void PhotoGuide::take_again() {
    if (!has_camera_ || (step_ != Step::mark && step_ != Step::find))
        return;
    photos_[index_].picture = {};
    photos_[index_].landmarks_px.reset();
    begin();
}

void PhotoGuide::leave_out() {
    if (!can_leave_out())
        return;
    photos_[index_].landmarks_px.reset();
    next();
}

void PhotoGuide::go_on() {
    if (!can_go_on())
        return;
    photos_[index_].landmarks_px = draft_->landmarks_px();
    next();
}

// The photo stays, and its turn comes again.
void PhotoGuide::go_back() {
    if (!can_go_back())
        return;
    --index_;
    begin();
}

void PhotoGuide::ask_finish() {
    asks_finish_ = can_finish();
}

void PhotoGuide::keep_taking() {
    asks_finish_ = false;
}

void PhotoGuide::finish() {
    if (!can_finish())
        return;
    // A photo whose landmarks are there counts.
    if (can_go_on())
        photos_[index_].landmarks_px = draft_->landmarks_px();
    index_ = photos_.size();
    begin();
}

void PhotoGuide::undo() {
    if (step_ != Step::mark)
        return;
    dragged_ = chosen_ = std::nullopt;
    cross_px_.reset();
    draft_->undo();
}

bool PhotoGuide::on_picture(ColorView picture, TimePoint now) {
    if (step_ != Step::count || now < photo_at_)
        return false;
    ColorImage taken(picture.size);
    copy_pixels<Rgb>(picture, taken.view());
    photos_[index_].picture = std::move(taken);
    begin();
    return true;
}

void PhotoGuide::on_found(const std::optional<face::Landmarks>& landmarks_px, Search search) {
    if (!draft_ || (step_ != Step::find && step_ != Step::mark))
        return;
    search_ = search;
    if (landmarks_px)
        draft_->take(*landmarks_px);
    step_ = Step::mark;
}

void PhotoGuide::press(Vec2 photo_px, double reach_px) {
    if (step_ != Step::mark)
        return;
    // A place that is asked for may lie beside one that is there: only a landmark right below the
    // mouse is meant then.
    const bool is_asked = draft_->next().has_value();
    dragged_ = draft_->near(photo_px, is_asked ? reach_px / 2 : reach_px);
    if (dragged_) {
        draft_->move(*dragged_, photo_px);
    } else if (is_asked) {
        draft_->put(photo_px);
        dragged_ = draft_->near(photo_px, 0.5);
    }
    chosen_ = dragged_;
    cross_px_.reset();
}

void PhotoGuide::drag(Vec2 photo_px) {
    if (step_ == Step::mark && dragged_)
        draft_->move(*dragged_, photo_px, true);
}

void PhotoGuide::nudge(Vec2 by_px) {
    if (step_ != Step::mark)
        return;
    if (draft_->next() && !chosen_) {
        const Size size = photo().picture.size;
        const Vec2 from = cross_px_.value_or(Vec2{size.width / 2.0, size.height / 2.0});
        cross_px_ = {std::clamp(from.x + by_px.x, 0.0, double(size.width)),
                     std::clamp(from.y + by_px.y, 0.0, double(size.height))};
        return;
    }
    if (!chosen_ || !draft_->is_shown(*chosen_))
        return;
    const Vec2 at = draft_->point(*chosen_);
    draft_->move(*chosen_, {at.x + by_px.x, at.y + by_px.y}, true);
}

void PhotoGuide::put_at_cross() {
    if (const auto cross = cross_px())
        draft_->put(*cross);
}

std::vector<Photo> PhotoGuide::take_photos() {
    std::vector<Photo> taken = std::exchange(photos_, {});
    std::erase_if(taken, [](const Photo& photo) { return !photo.landmarks_px; });
    return taken;
}

}  // namespace theatron::enrol
