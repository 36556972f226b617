#include "session/finish.h"

#include <chrono>
#include <exception>
#include <new>

#include "encode/jpeg.h"
#include "encode/png.h"
#include "plan/annotations.h"

namespace radiata::session {

StreamFrame finish(model::Frame frame, ImageFormat format, encode::Annotator& annotator) {
    const auto start = std::chrono::steady_clock::now();
    encode::Picture picture{frame.pixels.width, frame.pixels.height, std::move(frame.pixels.rgba)};
    frame.pixels.rgba.clear();
    const plan::SubsetFacts facts{frame.info.glyphs, frame.info.glyphs_available, frame.info.left_out};
    annotator.draw(picture, plan::annotations(frame.info.request, frame.info.state, frame.info.samples, facts));
    annotator.drawBars(picture, plan::colourBars(frame.info.request));

    StreamFrame finished;
    finished.width = picture.width;
    finished.height = picture.height;
    finished.format = format;
    finished.image = format == ImageFormat::kPng ? encode::encodePng(picture)
                                                 : encode::encodeJpeg(picture, frame.info.request.quality.jpeg_quality);
    finished.timing.render_ms = frame.info.render_ms;
    finished.timing.encode_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    finished.info = std::move(frame.info);
    finished.outputs = std::move(frame.pixels);
    return finished;
}

Error currentError() {
    try {
        throw;
    } catch (const Error& error) {
        return error;
    } catch (const std::bad_alloc&) {
        return {Code::kResourceExhausted,
                "the server has no memory for this picture; ask for a smaller one or try again later"};
    } catch (const std::exception& error) {
        return {Code::kInternal, std::string("unexpected failure: ") + error.what()};
    } catch (...) {
        return {Code::kInternal, "unexpected failure"};
    }
}

}  // namespace radiata::session
