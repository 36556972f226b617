-- Turns a gRPC answer into a gRPC-Web one: browsers cannot read HTTP trailers, so they get them as a last frame of the body.
-- The frame: one byte 0x80, the length as four bytes big-endian, then "name: value\r\n" lines.
-- Source: PROTOCOL-WEB.md of the gRPC project.
local grpc_web = {}

local CONTENT_TYPE = "application/grpc-web+proto"

-- Statuses of gRPC for HTTP statuses that something on the way, not a gRPC server, answered with (http-grpc-status-mapping.md).
local STATUS_OF_HTTP = { [400] = 13, [401] = 16, [403] = 7, [404] = 12, [429] = 14, [502] = 14, [503] = 14, [504] = 14 }

local function present(value)
  return value ~= nil and value ~= ""
end

local function bytes_of(length)
  local b = {}
  for i = 4, 1, -1 do
    b[i] = string.char(length % 256)
    length = math.floor(length / 256)
  end
  return table.concat(b)
end

-- The last frame of an answer. Values come as the server wrote them: messages are percent-encoded, details base64.
-- Without a status the answer broke off on the way: 14, unavailable.
local function trailer_frame(status, message, details)
  local lines = { "grpc-status: " .. (present(status) and status or "14") }
  if present(message) then
    lines[#lines + 1] = "grpc-message: " .. message
  elseif not present(status) then
    lines[#lines + 1] = "grpc-message: the answer ended without a status"
  end
  if present(details) then lines[#lines + 1] = "grpc-status-details-bin: " .. details end
  local text = table.concat(lines, "\r\n") .. "\r\n"
  return string.char(0x80) .. bytes_of(#text) .. text
end

function grpc_web.header()
  local answered = ngx.header["Content-Type"]
  ngx.ctx.refused = present(ngx.header["grpc-status"])
  if not ngx.ctx.refused and not (type(answered) == "string" and answered:find("^application/grpc")) then
    -- Not gRPC at all: the body would be taken for frames, so it is dropped and the status says why.
    ngx.ctx.foreign = true
    ngx.header["grpc-status"] = STATUS_OF_HTTP[ngx.status] or 2
    ngx.header["grpc-message"] = "the server answered with HTTP status " .. ngx.status .. " instead of gRPC"
    ngx.status = 200
  end
  ngx.header["Content-Type"] = CONTENT_TYPE
  ngx.header["Content-Length"] = nil
  ngx.header["Cache-Control"] = "no-store"
end

function grpc_web.body()
  local context = ngx.ctx
  if context.foreign then
    ngx.arg[1] = nil
    return
  end
  -- A refusal without a body carries its status among the headers already; and the end may be signalled more than once.
  if not ngx.arg[2] or context.ended or context.refused then return end
  context.ended = true
  local frame = trailer_frame(ngx.var.upstream_trailer_grpc_status, ngx.var.upstream_trailer_grpc_message,
                              ngx.var.upstream_trailer_grpc_status_details_bin)
  ngx.arg[1] = (ngx.arg[1] or "") .. frame
end

-- Answers a request that never reached the server: the status among the headers, no body.
function grpc_web.refuse(status, message)
  ngx.status = 200
  ngx.header["Content-Type"] = CONTENT_TYPE
  ngx.header["Cache-Control"] = "no-store"
  ngx.header["grpc-status"] = status
  ngx.header["grpc-message"] = message
  ngx.exit(200)
end

return grpc_web
