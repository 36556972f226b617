// Which failures pass by themselves, and how the others are told to a person.
import { Code, ConnectError } from "@connectrpc/connect";

/** Whether opening the view again may help. A server that dies in mid-stream shows as Unknown or Aborted in a browser, because the
 *  trailers that name the cause never come; NotFound means that a restarted server does not know the view any more. */
export function passes(error: unknown): boolean {
  switch (ConnectError.from(error).code) {
    case Code.InvalidArgument:
    case Code.PermissionDenied:
    case Code.Unauthenticated:
    case Code.Unimplemented:
    case Code.FailedPrecondition:
    case Code.OutOfRange:
      return false;
    default:
      return true;
  }
}

export const isViewGone = (error: unknown): boolean => ConnectError.from(error).code === Code.NotFound;

export const sentence = (error: unknown): string => ConnectError.from(error).rawMessage || String(error);
