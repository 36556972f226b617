// The server's services, reached as gRPC-Web through the page's own origin.
import { type Client, type Transport, createClient } from "@connectrpc/connect";
import { createGrpcWebTransport } from "@connectrpc/connect-web";
import { Health } from "./generated/grpc/health/v1/health_pb";
import { CatalogService } from "./generated/radiata/v1/catalog_pb";
import { LimitsService } from "./generated/radiata/v1/limits_pb";
import { PickService } from "./generated/radiata/v1/pick_pb";
import { ViewService } from "./generated/radiata/v1/view_pb";

export interface Services {
  readonly catalog: Client<typeof CatalogService>;
  readonly limits: Client<typeof LimitsService>;
  readonly view: Client<typeof ViewService>;
  readonly pick: Client<typeof PickService>;
  readonly health: Client<typeof Health>;
}

export const connectServices = (baseUrl: string): Services => servicesOver(createGrpcWebTransport({ baseUrl }));

export function servicesOver(transport: Transport): Services {
  return {
    catalog: createClient(CatalogService, transport),
    limits: createClient(LimitsService, transport),
    view: createClient(ViewService, transport),
    pick: createClient(PickService, transport),
    health: createClient(Health, transport),
  };
}
