// SPDX-License-Identifier: Apache-2.0
#include "face/recording.h"

#include <gtest/gtest.h>

namespace theatron::face {
namespace {

const std::string head = "# theatron face 1\n# source xr_fb\n# synthetic no\n";

TEST(FaceRecording, ReadsColumnsAsTheSourceNamesThem) {
    const RecordingRead read = parse_recording(
        head +
        "time_s,take,label,XR_FACE_EXPRESSION_JAW_DROP_FB,LIP_CORNER_PULLER_L\n"
        "0.0,1,happiness,0.5,1\r\n0.1,1,happiness,0.25,\n0.2,2,fear,0,0\n0.3,2,neutral,0,0\n");
    ASSERT_EQ(read.problem, "");
    const Recording& recording = read.recording;
    EXPECT_EQ(recording.source, Source::xr_fb_face2);
    EXPECT_EQ(recording.left_out_rows, 1U);
    ASSERT_EQ(recording.takes.size(), 2U);
    const Take& smile = recording.takes[0];
    ASSERT_EQ(smile.samples.size(), 2U);
    EXPECT_EQ(smile.label, Emotion::happiness);
    EXPECT_FLOAT_EQ(smile.samples[1].values[jaw_open], 0.25F);
    EXPECT_TRUE(smile.present[jaw_open]);
    EXPECT_FALSE(smile.present[mouth_smile_left]) << "missing in one row";
}

TEST(FaceRecording, ReadsWhatItWrites) {
    Recording recording;
    recording.source = Source::xr_htc;
    recording.is_synthetic = true;
    Take take;
    take.label = Emotion::anger;
    take.present = table_of(Source::xr_htc).mask;
    take.present.reset(jaw_open);
    take.samples.resize(2);
    take.samples[1].time_s = 0.5F;
    take.samples[1].values[mouth_pucker] = 0.125F;
    recording.takes = {take, take};
    const RecordingRead read = parse_recording(recording_text(recording));
    ASSERT_EQ(read.problem, "");
    EXPECT_TRUE(read.recording.is_synthetic);
    ASSERT_EQ(read.recording.takes.size(), 2U);
    EXPECT_EQ(read.recording.takes[1].present, take.present);
    EXPECT_EQ(read.recording.takes[1].samples[1].values, take.samples[1].values);
    EXPECT_EQ(recording_text(read.recording), recording_text(recording));
}

TEST(FaceRecording, SaysWhatIsWrongAndWhere) {
    const std::string columns = head + "time_s,take,label,JAW_DROP\n";
    for (const auto& [text, problem] : {
             std::pair(std::string("time_s,take\n"),
                       "line 1: the first line is not '# theatron face 1'"),
             std::pair(std::string("# theatron face 1\n# source quest\n"),
                       "line 2: the source is none of arkit, unified, xr_fb, xr_htc"),
             std::pair(head + "time_s,take,label,NOSE\n",
                       "line 4: a column has a name that the source does not know"),
             std::pair(head + "time,JAW_DROP\n",
                       "line 4: the columns do not begin with time_s,take,label"),
             std::pair(columns, "there is no row of values"),
             std::pair(columns + "0,0,anger\n",
                       "line 5: the row has another number of fields than the columns"),
             std::pair(columns + "0,0,anger,wide\n", "line 5: a value is no number"),
             std::pair(columns + "0,0,anger,nan\n", "line 5: a value is no number"),
             std::pair(columns + "-1,0,anger,1\n",
                       "line 5: the time or the number of the take is no number in range"),
             std::pair(columns + "2,0,anger,1\n1,0,anger,1\n",
                       "line 6: the time goes back within a take"),
         })
        EXPECT_EQ(parse_recording(text).problem, problem);
}

}  // namespace
}  // namespace theatron::face
