// SPDX-License-Identifier: Apache-2.0
// The functions of FFmpeg that this program calls, by library. A function that is called and not
// listed here is an error of the linker. No variables: those cannot be forwarded.
#pragma once

// X(NAME)
#define THEATRON_AVUTIL_FUNCTIONS(X) \
    X(av_base64_encode)              \
    X(av_dict_free)                  \
    X(av_dict_get)                   \
    X(av_dict_set)                   \
    X(av_display_matrix_flip)        \
    X(av_display_rotation_set)       \
    X(av_frame_alloc)                \
    X(av_frame_free)                 \
    X(av_frame_get_buffer)           \
    X(av_frame_get_side_data)        \
    X(av_frame_make_writable)        \
    X(av_frame_unref)                \
    X(av_freep)                      \
    X(av_image_get_linesize)         \
    X(av_log_set_callback)           \
    X(av_log_set_level)              \
    X(av_malloc)                     \
    X(av_md5_sum)                    \
    X(av_opt_set)                    \
    X(av_opt_set_double)             \
    X(av_opt_set_int)                \
    X(av_pix_fmt_desc_get)           \
    X(av_rescale_q)

#define THEATRON_AVCODEC_FUNCTIONS(X) \
    X(av_new_packet)                  \
    X(av_packet_alloc)                \
    X(av_packet_free)                 \
    X(av_packet_get_side_data)        \
    X(av_packet_unref)                \
    X(avcodec_alloc_context3)         \
    X(avcodec_find_decoder)           \
    X(avcodec_find_encoder_by_name)   \
    X(avcodec_free_context)           \
    X(avcodec_get_name)               \
    X(avcodec_open2)                  \
    X(avcodec_parameters_to_context)  \
    X(avcodec_receive_frame)          \
    X(avcodec_receive_packet)         \
    X(avcodec_send_frame)             \
    X(avcodec_send_packet)

#define THEATRON_AVFORMAT_FUNCTIONS(X) \
    X(av_find_best_stream)             \
    X(av_find_input_format)            \
    X(av_guess_frame_rate)             \
    X(av_guess_sample_aspect_ratio)    \
    X(av_probe_input_buffer2)          \
    X(av_read_frame)                   \
    X(av_stream_get_side_data)         \
    X(avformat_alloc_context)          \
    X(avformat_close_input)            \
    X(avformat_find_stream_info)       \
    X(avformat_open_input)             \
    X(avio_alloc_context)              \
    X(avio_context_free)

#define THEATRON_SWSCALE_FUNCTIONS(X) \
    X(sws_freeContext)                \
    X(sws_getCachedContext)           \
    X(sws_getCoefficients)            \
    X(sws_getContext)                 \
    X(sws_scale)                      \
    X(sws_setColorspaceDetails)
