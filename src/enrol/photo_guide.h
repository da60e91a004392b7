// SPDX-License-Identifier: Apache-2.0
// The way through the photos of a person's own face: each is taken from a camera, or given, and
// then its landmarks are found or marked.
//
// Neither window nor camera is known here: pictures, places and time come in, and photos come out.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/time.h"
#include "face/enrol.h"
#include "face/landmark_check.h"
#include "face/landmark_draft.h"

namespace theatron::enrol {

struct Photo {
    face::Emotion emotion = face::Emotion::neutral;
    ColorImage picture;
    std::optional<face::Landmarks> landmarks_px;
};

// The order in which photos are taken and shown: neutral first, those that are easy to play next.
inline constexpr std::array<face::Emotion, face::emotion_count> photo_order = {
    face::Emotion::neutral, face::Emotion::happiness, face::Emotion::surprise,
    face::Emotion::sadness, face::Emotion::disgust,   face::Emotion::anger};

// From one thread.
class PhotoGuide {
public:
    enum class Step {
        look,   // the camera's picture is shown until the photo is taken
        count,  // the photo is about to be taken
        find,   // its landmarks are looked for
        mark,   // the person marks them, or looks at those that were found
        done,
    };
    // Time between the person's choice to take a photo and the photo.
    static constexpr Duration count_down = std::chrono::seconds(3);

    // Takes one photo of each emotion. `usual`: of each emotion, as face::usual_landmarks().
    using Usual = std::array<face::Landmarks, face::emotion_count>;
    static PhotoGuide from_camera(const Usual& usual);
    // Goes through these photos, in their order. At least one.
    static PhotoGuide of_photos(std::vector<Photo> photos, const Usual& usual);

    Step step() const { return step_; }
    face::Emotion emotion() const { return photo().emotion; }
    bool has_camera() const { return has_camera_; }
    std::size_t index() const { return index_; }
    std::size_t count() const { return photos_.size(); }
    // Another number whenever another picture is asked for or shown.
    std::size_t turn() const { return turn_; }
    // The photo whose turn it is; its picture is empty while the step is `look` or `count`.
    const Photo& photo() const { return photos_[std::min(index_, photos_.size() - 1)]; }
    // Its landmarks; at step `mark`.
    const face::LandmarkDraft& draft() const { return *draft_; }
    // The outcome of the search for them in this photo. `given`: they came with it.
    enum class Search { none, given, found, found_largest, no_face };
    Search search() const { return search_; }
    // Why the landmarks cannot be kept; nullopt: they can, or they are not all there yet.
    std::optional<face::LandmarkFault> fault() const;
    // The landmark that the person moved last.
    std::optional<std::size_t> chosen() const { return chosen_; }
    // The cross with which a person without a mouse sets the place that is asked for.
    std::optional<Vec2> cross_px() const;
    // Seconds until the photo is taken, at step `count`: 3, 2, 1.
    int seconds_left(TimePoint now) const;

    bool can_leave_out() const;  // this photo
    bool can_finish() const;     // the neutral photo is done, and others need not be taken
    bool can_go_on() const;      // from step `mark`: all landmarks are there, and can be a face's
    bool can_go_back() const;    // to the photo before
    // finish() has asked whether the photos that are there are enough.
    bool asks_finish() const { return asks_finish_; }
    // Emotions without a photo, in the order of the photos.
    std::vector<face::Emotion> missing() const;

    // The person's choices. One that is not possible at this step does nothing.
    void take_photo(TimePoint now);
    void stop_counting();
    void take_again();
    void leave_out();
    void go_on();
    void go_back();
    void ask_finish();
    void keep_taking();  // the answer: no
    void finish();       // the answer: yes
    void undo();

    // The picture of the camera that is shown now. Takes the photo when it is time. True: it was
    // taken.
    bool on_picture(ColorView picture, TimePoint now);
    // The landmarks that were found in the photo; nullopt: none. At step `find`.
    void on_found(const std::optional<face::Landmarks>& landmarks_px, Search search);

    // The mouse was pressed at this place of the photo: takes the landmark there, or puts the place
    // that is asked for.
    void press(Vec2 photo_px, double reach_px);
    void drag(Vec2 photo_px);
    void release() { dragged_.reset(); }
    // Moves the landmark that was moved last; while a place is asked for and none was, the cross.
    void nudge(Vec2 by_px);
    void put_at_cross();

    // Those with landmarks; at step `done`.
    std::vector<Photo> take_photos();

private:
    PhotoGuide(std::vector<Photo> photos, const Usual& usual, bool has_camera);

    void begin();
    void next();

    Usual usual_;
    bool has_camera_ = false;
    std::vector<Photo> photos_;
    std::size_t index_ = 0, turn_ = 0;
    Step step_ = Step::look;
    TimePoint photo_at_;  // at step `count`
    std::optional<face::LandmarkDraft> draft_;
    Search search_ = Search::none;
    bool asks_finish_ = false;
    std::optional<std::size_t> dragged_, chosen_;
    std::optional<Vec2> cross_px_;
};

}  // namespace theatron::enrol
