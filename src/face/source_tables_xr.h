// SPDX-License-Identifier: Apache-2.0
// The tables of OpenXR's sources, in the order of their arrays. Names: Khronos' openxr.h, without
// prefix and ending (Apache-2.0 OR MIT).
#pragma once

#include "face/sources.h"

namespace theatron::face {

constexpr std::string_view fb_inputs[] = {"BROW_LOWERER_L",
                                          "BROW_LOWERER_R",
                                          "CHEEK_PUFF_L",
                                          "CHEEK_PUFF_R",
                                          "CHEEK_RAISER_L",
                                          "CHEEK_RAISER_R",
                                          "CHEEK_SUCK_L",
                                          "CHEEK_SUCK_R",
                                          "CHIN_RAISER_B",
                                          "CHIN_RAISER_T",
                                          "DIMPLER_L",
                                          "DIMPLER_R",
                                          "EYES_CLOSED_L",
                                          "EYES_CLOSED_R",
                                          "EYES_LOOK_DOWN_L",
                                          "EYES_LOOK_DOWN_R",
                                          "EYES_LOOK_LEFT_L",
                                          "EYES_LOOK_LEFT_R",
                                          "EYES_LOOK_RIGHT_L",
                                          "EYES_LOOK_RIGHT_R",
                                          "EYES_LOOK_UP_L",
                                          "EYES_LOOK_UP_R",
                                          "INNER_BROW_RAISER_L",
                                          "INNER_BROW_RAISER_R",
                                          "JAW_DROP",
                                          "JAW_SIDEWAYS_LEFT",
                                          "JAW_SIDEWAYS_RIGHT",
                                          "JAW_THRUST",
                                          "LID_TIGHTENER_L",
                                          "LID_TIGHTENER_R",
                                          "LIP_CORNER_DEPRESSOR_L",
                                          "LIP_CORNER_DEPRESSOR_R",
                                          "LIP_CORNER_PULLER_L",
                                          "LIP_CORNER_PULLER_R",
                                          "LIP_FUNNELER_LB",
                                          "LIP_FUNNELER_LT",
                                          "LIP_FUNNELER_RB",
                                          "LIP_FUNNELER_RT",
                                          "LIP_PRESSOR_L",
                                          "LIP_PRESSOR_R",
                                          "LIP_PUCKER_L",
                                          "LIP_PUCKER_R",
                                          "LIP_STRETCHER_L",
                                          "LIP_STRETCHER_R",
                                          "LIP_SUCK_LB",
                                          "LIP_SUCK_LT",
                                          "LIP_SUCK_RB",
                                          "LIP_SUCK_RT",
                                          "LIP_TIGHTENER_L",
                                          "LIP_TIGHTENER_R",
                                          "LIPS_TOWARD",
                                          "LOWER_LIP_DEPRESSOR_L",
                                          "LOWER_LIP_DEPRESSOR_R",
                                          "MOUTH_LEFT",
                                          "MOUTH_RIGHT",
                                          "NOSE_WRINKLER_L",
                                          "NOSE_WRINKLER_R",
                                          "OUTER_BROW_RAISER_L",
                                          "OUTER_BROW_RAISER_R",
                                          "UPPER_LID_RAISER_L",
                                          "UPPER_LID_RAISER_R",
                                          "UPPER_LIP_RAISER_L",
                                          "UPPER_LIP_RAISER_R",
                                          "TONGUE_TIP_INTERDENTAL",
                                          "TONGUE_TIP_ALVEOLAR",
                                          "TONGUE_FRONT_DORSAL_PALATE",
                                          "TONGUE_MID_DORSAL_PALATE",
                                          "TONGUE_BACK_DORSAL_VELAR",
                                          "TONGUE_OUT",
                                          "TONGUE_RETREAT"};
constexpr Term fb_terms[] = {
    {12, eye_blink_left},                         // EYES_CLOSED_L
    {13, eye_blink_right},                        // EYES_CLOSED_R
    {14, eye_look_down_left},                     // EYES_LOOK_DOWN_L
    {15, eye_look_down_right},                    // EYES_LOOK_DOWN_R
    {20, eye_look_up_left},                       // EYES_LOOK_UP_L
    {21, eye_look_up_right},                      // EYES_LOOK_UP_R
    {18, eye_look_in_left},                       // EYES_LOOK_RIGHT_L
    {16, eye_look_out_left},                      // EYES_LOOK_LEFT_L
    {17, eye_look_in_right},                      // EYES_LOOK_LEFT_R
    {19, eye_look_out_right},                     // EYES_LOOK_RIGHT_R
    {28, eye_squint_left},                        // LID_TIGHTENER_L
    {29, eye_squint_right},                       // LID_TIGHTENER_R
    {59, eye_wide_left},                          // UPPER_LID_RAISER_L
    {60, eye_wide_right},                         // UPPER_LID_RAISER_R
    {27, jaw_forward},                            // JAW_THRUST
    {25, jaw_left},                               // JAW_SIDEWAYS_LEFT
    {26, jaw_right},                              // JAW_SIDEWAYS_RIGHT
    {24, jaw_open},                               // JAW_DROP
    {50, mouth_close},                            // LIPS_TOWARD
    {34, mouth_funnel},                           // LIP_FUNNELER_LB
    {35, mouth_funnel},                           // LIP_FUNNELER_LT
    {36, mouth_funnel},                           // LIP_FUNNELER_RB
    {37, mouth_funnel},                           // LIP_FUNNELER_RT
    {40, mouth_pucker},                           // LIP_PUCKER_L
    {41, mouth_pucker},                           // LIP_PUCKER_R
    {53, mouth_left},                             // MOUTH_LEFT
    {54, mouth_right},                            // MOUTH_RIGHT
    {32, mouth_smile_left},                       // LIP_CORNER_PULLER_L
    {33, mouth_smile_right},                      // LIP_CORNER_PULLER_R
    {30, mouth_frown_left},                       // LIP_CORNER_DEPRESSOR_L
    {31, mouth_frown_right},                      // LIP_CORNER_DEPRESSOR_R
    {10, mouth_dimple_left},                      // DIMPLER_L
    {11, mouth_dimple_right},                     // DIMPLER_R
    {42, mouth_stretch_left},                     // LIP_STRETCHER_L
    {43, mouth_stretch_right},                    // LIP_STRETCHER_R
    {44, mouth_roll_lower},                       // LIP_SUCK_LB
    {46, mouth_roll_lower},                       // LIP_SUCK_RB
    {45, mouth_roll_upper},                       // LIP_SUCK_LT
    {47, mouth_roll_upper},                       // LIP_SUCK_RT
    {8, mouth_shrug_lower},                       // CHIN_RAISER_B
    {9, mouth_shrug_upper},                       // CHIN_RAISER_T
    {38, mouth_press_left},                       // LIP_PRESSOR_L
    {39, mouth_press_right},                      // LIP_PRESSOR_R
    {48, mouth_press_left, Shape::plain, 0.5F},   // LIP_TIGHTENER_L
    {49, mouth_press_right, Shape::plain, 0.5F},  // LIP_TIGHTENER_R
    {51, mouth_lower_down_left},                  // LOWER_LIP_DEPRESSOR_L
    {52, mouth_lower_down_right},                 // LOWER_LIP_DEPRESSOR_R
    {61, mouth_upper_up_left},                    // UPPER_LIP_RAISER_L
    {62, mouth_upper_up_right},                   // UPPER_LIP_RAISER_R
    {0, brow_down_left},                          // BROW_LOWERER_L
    {1, brow_down_right},                         // BROW_LOWERER_R
    {22, brow_inner_up},                          // INNER_BROW_RAISER_L
    {23, brow_inner_up},                          // INNER_BROW_RAISER_R
    {57, brow_outer_up_left},                     // OUTER_BROW_RAISER_L
    {58, brow_outer_up_right},                    // OUTER_BROW_RAISER_R
    {2, cheek_puff},                              // CHEEK_PUFF_L
    {3, cheek_puff},                              // CHEEK_PUFF_R
    {4, cheek_squint_left},                       // CHEEK_RAISER_L
    {5, cheek_squint_right},                      // CHEEK_RAISER_R
    {55, nose_sneer_left},                        // NOSE_WRINKLER_L
    {56, nose_sneer_right},                       // NOSE_WRINKLER_R
    {68, tongue_out},                             // TONGUE_OUT
};

constexpr std::string_view htc_inputs[] = {"EYE_LEFT_BLINK",
                                           "EYE_LEFT_WIDE",
                                           "EYE_RIGHT_BLINK",
                                           "EYE_RIGHT_WIDE",
                                           "EYE_LEFT_SQUEEZE",
                                           "EYE_RIGHT_SQUEEZE",
                                           "EYE_LEFT_DOWN",
                                           "EYE_RIGHT_DOWN",
                                           "EYE_LEFT_OUT",
                                           "EYE_RIGHT_IN",
                                           "EYE_LEFT_IN",
                                           "EYE_RIGHT_OUT",
                                           "EYE_LEFT_UP",
                                           "EYE_RIGHT_UP",
                                           "LIP_JAW_RIGHT",
                                           "LIP_JAW_LEFT",
                                           "LIP_JAW_FORWARD",
                                           "LIP_JAW_OPEN",
                                           "LIP_MOUTH_APE_SHAPE",
                                           "LIP_MOUTH_UPPER_RIGHT",
                                           "LIP_MOUTH_UPPER_LEFT",
                                           "LIP_MOUTH_LOWER_RIGHT",
                                           "LIP_MOUTH_LOWER_LEFT",
                                           "LIP_MOUTH_UPPER_OVERTURN",
                                           "LIP_MOUTH_LOWER_OVERTURN",
                                           "LIP_MOUTH_POUT",
                                           "LIP_MOUTH_RAISER_RIGHT",
                                           "LIP_MOUTH_RAISER_LEFT",
                                           "LIP_MOUTH_STRETCHER_RIGHT",
                                           "LIP_MOUTH_STRETCHER_LEFT",
                                           "LIP_CHEEK_PUFF_RIGHT",
                                           "LIP_CHEEK_PUFF_LEFT",
                                           "LIP_CHEEK_SUCK",
                                           "LIP_MOUTH_UPPER_UPRIGHT",
                                           "LIP_MOUTH_UPPER_UPLEFT",
                                           "LIP_MOUTH_LOWER_DOWNRIGHT",
                                           "LIP_MOUTH_LOWER_DOWNLEFT",
                                           "LIP_MOUTH_UPPER_INSIDE",
                                           "LIP_MOUTH_LOWER_INSIDE",
                                           "LIP_MOUTH_LOWER_OVERLAY",
                                           "LIP_TONGUE_LONGSTEP1",
                                           "LIP_TONGUE_LEFT",
                                           "LIP_TONGUE_RIGHT",
                                           "LIP_TONGUE_UP",
                                           "LIP_TONGUE_DOWN",
                                           "LIP_TONGUE_ROLL",
                                           "LIP_TONGUE_LONGSTEP2",
                                           "LIP_TONGUE_UPRIGHT_MORPH",
                                           "LIP_TONGUE_UPLEFT_MORPH",
                                           "LIP_TONGUE_DOWNRIGHT_MORPH",
                                           "LIP_TONGUE_DOWNLEFT_MORPH"};
constexpr Term htc_terms[] = {
    {0, eye_blink_left},           // EYE_LEFT_BLINK
    {1, eye_wide_left},            // EYE_LEFT_WIDE
    {4, eye_squint_left},          // EYE_LEFT_SQUEEZE
    {6, eye_look_down_left},       // EYE_LEFT_DOWN
    {8, eye_look_out_left},        // EYE_LEFT_OUT
    {10, eye_look_in_left},        // EYE_LEFT_IN
    {12, eye_look_up_left},        // EYE_LEFT_UP
    {15, jaw_left},                // LIP_JAW_LEFT
    {20, mouth_left},              // LIP_MOUTH_UPPER_LEFT
    {22, mouth_left},              // LIP_MOUTH_LOWER_LEFT
    {27, mouth_smile_left},        // LIP_MOUTH_RAISER_LEFT
    {29, mouth_frown_left},        // LIP_MOUTH_STRETCHER_LEFT
    {31, cheek_puff},              // LIP_CHEEK_PUFF_LEFT
    {34, mouth_upper_up_left},     // LIP_MOUTH_UPPER_UPLEFT
    {36, mouth_lower_down_left},   // LIP_MOUTH_LOWER_DOWNLEFT
    {2, eye_blink_right},          // EYE_RIGHT_BLINK
    {3, eye_wide_right},           // EYE_RIGHT_WIDE
    {5, eye_squint_right},         // EYE_RIGHT_SQUEEZE
    {7, eye_look_down_right},      // EYE_RIGHT_DOWN
    {11, eye_look_out_right},      // EYE_RIGHT_OUT
    {9, eye_look_in_right},        // EYE_RIGHT_IN
    {13, eye_look_up_right},       // EYE_RIGHT_UP
    {14, jaw_right},               // LIP_JAW_RIGHT
    {19, mouth_right},             // LIP_MOUTH_UPPER_RIGHT
    {21, mouth_right},             // LIP_MOUTH_LOWER_RIGHT
    {26, mouth_smile_right},       // LIP_MOUTH_RAISER_RIGHT
    {28, mouth_frown_right},       // LIP_MOUTH_STRETCHER_RIGHT
    {30, cheek_puff},              // LIP_CHEEK_PUFF_RIGHT
    {33, mouth_upper_up_right},    // LIP_MOUTH_UPPER_UPRIGHT
    {35, mouth_lower_down_right},  // LIP_MOUTH_LOWER_DOWNRIGHT
    {16, jaw_forward},             // LIP_JAW_FORWARD
    {17, jaw_open},                // LIP_JAW_OPEN
    {18, mouth_close},             // LIP_MOUTH_APE_SHAPE
    {23, mouth_funnel},            // LIP_MOUTH_UPPER_OVERTURN
    {24, mouth_funnel},            // LIP_MOUTH_LOWER_OVERTURN
    {25, mouth_pucker},            // LIP_MOUTH_POUT
    {37, mouth_roll_upper},        // LIP_MOUTH_UPPER_INSIDE
    {38, mouth_roll_lower},        // LIP_MOUTH_LOWER_INSIDE
    {39, mouth_shrug_lower},       // LIP_MOUTH_LOWER_OVERLAY
    {40, tongue_out},              // LIP_TONGUE_LONGSTEP1
    {46, tongue_out},              // LIP_TONGUE_LONGSTEP2
};

}  // namespace theatron::face
