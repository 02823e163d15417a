// Reads a log as Foxglove does: by its index, with the packages of its makers (https://github.com/foxglove/mcap). Every
// message is JSON with a schema, in the order of time, and as many as the summary says. Usage: node read.mjs FILE
import { open } from "node:fs/promises";

import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";

function want(holds, what) {
  if (!holds) {
    console.error(`read.mjs: ${what}`);
    process.exit(1);
  }
}

const file = await open(process.argv[2]);
const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(file) });
let count = 0n;
let last = 0n;
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  want(channel.messageEncoding === "json" && schema.encoding === "jsonschema", `${channel.topic} is not JSON with a schema`);
  const event = JSON.parse(new TextDecoder().decode(message.data));
  const known = JSON.parse(new TextDecoder().decode(schema.data)).properties;
  want(Object.keys(event).every((key) => key in known), `${channel.topic}: a field that the schema does not have`);
  want(message.logTime >= last, `${channel.topic}: time goes back`);
  last = message.logTime;
  count += 1n;
}
want(count > 0n && count === reader.statistics.messageCount, `${count} messages, the summary says ${reader.statistics.messageCount}`);
want(reader.metadataIndexes.length >= 2, "the metadata are not found");
console.log(`read.mjs: ${count} events of ${reader.channelsById.size} tasks`);
await file.close();
