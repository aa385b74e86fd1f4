// What modbus-serial says and hears: `node modbus_serial.js master WHERE UNIT` and `... slave PORT`.
const ModbusRTU = require("modbus-serial");

const [role, where, unit] = process.argv.slice(2);

async function asMaster() {
  const client = new ModbusRTU();
  if (where.startsWith("/")) await client.connectRTUBuffered(where, { baudRate: 38400, stopBits: 2 });
  else await client.connectTCP("127.0.0.1", { port: Number(where) });
  client.setID(Number(unit));
  client.setTimeout(2000);
  const mode = (await client.readHoldingRegisters(0x0003, 1)).data[0];
  await client.writeRegister(0x0401, 0x0083);
  await client.writeRegisters(0x6200, [1, 0, 0x2710, 600, 100, 100, 0, 0x0010]);
  while ((await client.readHoldingRegisters(0x0b05, 1)).data[0] & 4);
  const position = (await client.readHoldingRegisters(0x602c, 2)).data;
  const refused = await client.readHoldingRegisters(0x7000, 1).catch((error) => error.modbusCode);
  console.log(JSON.stringify({ mode, position, refused }));
  client.close(() => {});
}

function asSlave() {
  const registers = new Uint16Array(256);
  const unknown = { modbusErrorCode: 0x02 };
  const vector = {
    getHoldingRegister: (address, _unit, done) =>
      address < registers.length ? done(null, registers[address]) : done(unknown),
    setRegister: (address, value, _unit, done) => {
      registers[address] = value;
      done();
    },
  };
  const server = new ModbusRTU.ServerTCP(vector, { host: "127.0.0.1", port: Number(where), unitID: 1 });
  server.on("initialized", () => console.log("ready"));
  process.stdin.on("end", () => process.exit(0)).resume();
}

if (role === "master") asMaster();
else asSlave();
