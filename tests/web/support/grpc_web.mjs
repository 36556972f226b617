// gRPC-Web by hand, so that tests see every byte of the trailer frame.

/** A request body: one frame with the message. */
export function frameOf(message) {
  const frame = Buffer.alloc(5 + message.length);
  frame.writeUInt32BE(message.length, 1);
  Buffer.from(message).copy(frame, 5);
  return frame;
}

/** Splits a body into frames; \throws Error if it ends inside one. */
export function framesOf(body) {
  const frames = [];
  for (let at = 0; at < body.length; ) {
    if (at + 5 > body.length) throw new Error(`a frame's header is cut off at byte ${at} of ${body.length}`);
    const length = body.readUInt32BE(at + 1);
    if (at + 5 + length > body.length) throw new Error(`a frame of ${length} bytes is cut off at byte ${at} of ${body.length}`);
    frames.push({ isTrailer: (body[at] & 0x80) !== 0, data: body.subarray(at + 5, at + 5 + length) });
    at += 5 + length;
  }
  return frames;
}

export function trailersOf(frame) {
  const lines = frame.data.toString("latin1").split("\r\n");
  if (lines.pop() !== "") throw new Error("the trailers do not end with a line break");
  return Object.fromEntries(lines.map((line) => [line.slice(0, line.indexOf(":")), line.slice(line.indexOf(":") + 1).trim()]));
}

/** Calls a method. \return HTTP status and headers, the messages, and all trailer frames there were */
export async function call(url, method, { message = Buffer.alloc(0), headers = {}, signal } = {}) {
  const answer = await fetch(`${url}/${method}`, {
    method: "POST",
    headers: { "content-type": "application/grpc-web+proto", "x-grpc-web": "1", ...headers },
    body: frameOf(message),
    signal,
  });
  const frames = framesOf(Buffer.from(await answer.arrayBuffer()));
  return {
    http: answer.status,
    headers: answer.headers,
    messages: frames.filter((frame) => !frame.isTrailer).map((frame) => frame.data),
    trailers: frames.filter((frame) => frame.isTrailer).map(trailersOf),
    endsWithTrailer: frames.length > 0 && frames[frames.length - 1].isTrailer,
  };
}
