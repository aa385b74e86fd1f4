/**
 * Messages that drives, lines, runs and the station produce in English only: `{name}` stands for any text,
 * `{name_text}` for whole sentences.
 */
export const reports: Record<string, string> = {
  // drives
  "Drive {unit} answered with exception {code}.": "驱动器 {unit} 以异常 {code} 应答。",
  "Drive {unit} does not know the function it was asked for (exception 01).":
    "驱动器 {unit} 不支持所请求的功能（异常 01）。",
  "Drive {unit} has no such register (exception 02); is it the configured model?":
    "驱动器 {unit} 没有该寄存器（异常 02）；型号是否与配置一致？",
  "Drive {unit} refuses the value or cannot take it now (exception 03).":
    "驱动器 {unit} 拒绝该值或此时无法接受（异常 03）。",
  "Drive {unit} needs longer for its reply (exception 05).": "驱动器 {unit} 需要更长时间应答（异常 05）。",
  "Drive {unit} received a frame with a wrong check sum (exception 08); check the line.":
    "驱动器 {unit} 收到校验和错误的报文（异常 08）；请检查线路。",
  "Drive {unit} does not answer the gateway (exception 0B); check cable, power and address.":
    "驱动器 {unit} 不应答网关（异常 0B）；请检查电缆、电源和地址。",
  "Drive {unit} was not given its command: a stop came first.": "驱动器 {unit} 未收到指令：停止先到。",
  "Drive {unit} gave no proper reply on {address}: {what}; check the line for noise and double addresses.":
    "驱动器 {unit} 在 {address} 上的应答不正确：{what}；请检查线路干扰和重复地址。",
  "Drive {unit} gave no proper reply on {address}: drive {other} answered {bytes}; check the gateway and the addresses.":
    "驱动器 {unit} 在 {address} 上的应答不正确：驱动器 {other} 应答了 {bytes}；请检查网关和地址。",
  "Drive {unit} does not answer on {address}; check cable, power and address.":
    "驱动器 {unit} 在 {address} 上没有应答；请检查电缆、电源和地址。",
  "The command came too late and was not carried out; look at the machine, then try again.":
    "命令到达过晚，未执行；请查看机器，然后重试。",
  // lines
  "{address} answered {bytes}, which is not Modbus TCP; check the address and the gateway's mode.":
    "{address} 应答了 {bytes}，不是 Modbus TCP；请检查地址和网关模式。",
  "{address} cannot carry {format} (a pseudo-terminal has neither parity nor 7 bits); add override=8N1 to its URL if that is intended.":
    "{address} 无法传输 {format}（伪终端没有校验位，也没有 7 位）；若确有此意，请在地址中加上 override=8N1。",
  "{address} cannot be reached: {why}; check cable, power and address.":
    "无法连接 {address}：{why}；请检查电缆、电源和地址。",
  "{address} cannot be opened: {why}; is it a device server with RFC 2217?":
    "无法打开 {address}：{why}；它是支持 RFC 2217 的串口服务器吗？",
  "{address} cannot be opened: {why}.": "无法打开 {address}：{why}。",
  "{address} sends back what it is sent (echo): switch the echo of its adapter off, or add echo=1 to its address.":
    "{address} 将收到的内容原样发回（回显）：请关闭适配器的回显，或在地址中加上 echo=1。",
  "{address} broke while {doing}: {why}.": "{address} 中断（{doing}时）：{why}。",
  "{address} echoed something else than it was sent; check the line.":
    "{address} 的回显与所发内容不同；请检查线路。",
  "{address} does not echo what it is sent, although its address says echo=1; remove that, or check the adapter.":
    "{address} 没有回显，但地址中有 echo=1；请去掉它，或检查适配器。",
  "{address} is not open; connect first.": "{address} 未打开；请先连接。",
  reading: "读取",
  writing: "写入",
  "the far end closed the connection": "对方关闭了连接",
  "nothing answers": "没有应答",
  // scales
  "The {name} does not answer on {address}; check cable and power.":
    "{name}在 {address} 上没有应答；请检查电缆和电源。",
  "The {name} does not answer on {address}; check cable, power and address.":
    "{name}在 {address} 上没有应答；请检查电缆、电源和地址。",
  "The {name} answered {reply}, which is not a reply it may give; check the line.":
    "{name}应答了 {reply}，这不是有效应答；请检查线路。",
  "The {name} marks its value as faulty: {why}.": "{name}将其数值标为错误：{why}。",
  "no error text is shown, look at head and cable": "未显示错误文本，请检查读数头和电缆",
  "The {name} counts in inches; set it to mm.": "{name}以英寸计数；请设为 mm。",
  'The {name} shows the unit "{unit}"; set it to mm.': "{name}显示的单位为“{unit}”；请设为 mm。",
  "The {name} has its sorting limits the wrong way round; correct them.": "{name}的分选限值颠倒；请更正。",
  "The {name} shows {series} instead of the present value; change its display.":
    "{name}显示的是 {series} 而不是当前值；请切换显示。",
  "The {name} printed {printed} mm but shows {shown} mm; check its unit and display step, and that the head stands still.":
    "{name}发送了 {printed} mm，但显示 {shown} mm；请检查单位和显示步长，以及读数头是否静止。",
  "The {name} refuses {command}; is it an ND 280, 281B or 287?":
    "{name}拒绝 {command}；它是 ND 280、281B 或 287 吗？",
  "The {name} answered {counts} counts in a row; check the line for noise, and whether the head stands still.":
    "{name}连续应答计数 {counts}；请检查线路干扰以及读数头是否静止。",
  "The {name} refuses command {command}h (error {error}h); is it the configured model?":
    "{name}拒绝命令 {command}h（错误 {error}h）；型号是否与配置一致？",
  "The {name} counts in {says}, the station file says resolution_mm = {resolution}; correct one of them.":
    "{name}以 {says} 计数，工作站文件中为 resolution_mm = {resolution}；请更正其中之一。",
  "The {name} received a telegram with a wrong check byte; check the line.":
    "{name}收到校验字节错误的报文；请检查线路。",
  "The {name} cannot measure: its gap to the tape is too large, its position is implausible, or it moves faster than 5 m/s; look at head and tape.":
    "{name}无法测量：与磁带的间隙过大、位置不可信或移动速度超过 5 m/s；请检查读数头和磁带。",
  // axes
  "{axis} was asked to move to {angle}.": "{axis}被要求移动到 {angle}。",
  "{axis} cannot be told {angle} deg; that is more pulses than it counts.":
    "{axis}不能接受 {angle}°；超出其脉冲计数范围。",
  "{axis} was asked for {speed} deg/s; 0 to {most} is possible.":
    "{axis}被要求以 {speed} °/s 运动；允许范围为 0 至 {most}。",
  "{axis} shows alarm {alarm}h; find its cause, then reset it.": "{axis}报警 {alarm}h；请查明原因后复位。",
  "{axis} can only be declared to stand at {angle} deg, where its drive's zero is, not at {other} deg.":
    "{axis}只能设定为 {angle}°（驱动器零点所在处），而不是 {other}°。",
  "{axis} is moving; its zero can be set at standstill only.": "{axis}正在运动；只能在静止时设定零点。",
  "{axis} counts {pulses} pulses a turn, the station file says {counts}; correct one of them.":
    "{axis}每转 {pulses} 个脉冲，工作站文件中为 {counts}；请更正其中之一。",
  "{axis} counts {pulses} steps a turn, the station file says {counts}; correct one of them.":
    "{axis}每转 {pulses} 步，工作站文件中为 {counts}；请更正其中之一。",
  "{axis} is in control mode {mode}; set P00.01 to {wanted} (PR mode) and switch it off and on.":
    "{axis}处于控制模式 {mode}；请将 P00.01 设为 {wanted}（PR 模式）并重新上电。",
  "{axis} has no output for servo-on; set one of P04.10 to P04.14 to {output}h.":
    "{axis}没有伺服使能输出；请将 P04.10 至 P04.14 之一设为 {output}h。",
  "{axis} is not switched on.": "{axis}未接通。",
  "{axis} stands at {pulses} pulses after its zero was set; it was not taken.":
    "设定零点后{axis}位于 {pulses} 个脉冲；零点未被接受。",
  "{axis} does not switch on; check its power stage and safety input.":
    "{axis}无法接通；请检查功率级和安全输入。",
  "{axis} did not confirm its stop; use the emergency stop. {why_text}.":
    "{axis}未确认停止；请按急停。{why_text}。",
  "{axis} does not know its position; home it or preset it first.": "{axis}不知道自身位置；请先回零或预置。",
  "{axis} has a communication watchdog of {set} ms instead of {wanted}.":
    "{axis}的通信看门狗为 {set} ms，而不是 {wanted}。",
  // motion
  "Position {position} is refused: {why}.": "位置 {position} 被拒绝：{why}。",
  "Position {position} is refused: joint {joint} would go to {angle} deg, {reach} deg about {zero} are allowed.":
    "位置 {position} 被拒绝：关节 {joint} 将转到 {angle}°，允许范围为 {zero} 两侧 {reach}°。",
  "The way to position {position} is refused: {why_text}.": "前往位置 {position} 的路径被拒绝：{why_text}。",
  "The way to position {position} is refused: {why_text}": "前往位置 {position} 的路径被拒绝：{why_text}",
  "({x}, {y}) mm is {excess} mm outside the workspace, {margin} mm is allowed":
    "({x}, {y}) mm 在工作空间外 {excess} mm，允许 {margin} mm",
  "Reading {number} at position {position} does not settle: its samples spread {spread} mm, {allowed} mm is allowed.":
    "位置 {position} 的读数 {number} 不稳定：样本散布 {spread} mm，允许 {allowed} mm。",
  "Not ready to start. {why_text}.": "尚不能启动。{why_text}。",
  "{interlock}: {why_text}": "{interlock}：{why_text}",
  "At position {position} joint {joint} stands at {angle} deg instead of {wanted}.":
    "在位置 {position}，关节 {joint} 位于 {angle}°，而不是 {wanted}。",
  "{axis} did not reach position {position} within {limit} s.":
    "{axis}未在 {limit} s 内到达位置 {position}。",
  "{axis} shows alarm {alarm}h on the way to position {position}; find its cause, the next run resets it.":
    "{axis}在前往位置 {position} 途中报警 {alarm}h；请查明原因，下一次运行会复位。",
  "{axis} lost its power on the way to position {position}.": "{axis}在前往位置 {position} 途中断电。",
  "Joint {joint} left its way to position {position}: it is at {angle} deg.":
    "关节 {joint} 偏离前往位置 {position} 的路径：位于 {angle}°。",
  "On the way to position {position} the scale does not give a number.":
    "前往位置 {position} 途中光栅尺没有给出数值。",
  "Guard door, on the way to position {position}: {why}.": "防护门，前往位置 {position} 途中：{why}。",
  "Temperature, on the way to position {position}: {why}.": "温度，前往位置 {position} 途中：{why}。",
  "Reading {number} at position {position} is not a number.": "位置 {position} 的读数 {number} 不是数字。",
  "Reading {number} at position {position} is implausible: the scale shows {mm} mm as before, although the joints moved; check its display and rod.":
    "位置 {position} 的读数 {number} 不可信：关节已运动，光栅尺仍显示 {mm} mm；请检查其显示和连杆。",
  "Reading {number} at position {position} is implausible: the scale moved {doubt} mm more than the joints say; check its rod and channel.":
    "位置 {position} 的读数 {number} 不可信：光栅尺比关节多移动了 {doubt} mm；请检查其连杆和通道。",
  "Standstill could not be confirmed, look at the arm ({why}).": "无法确认静止，请查看机械臂（{why}）。",
  "The zero of joint {joint} reads back {after} deg instead of {wanted}.":
    "关节 {joint} 的零点回读为 {after}°，而不是 {wanted}。",
  "Whether joint {joint} took the zero of run {run} cannot be told any more; calibrate again.":
    "已无法确定关节 {joint} 是否接受了运行 {run} 的零点；请重新标定。",
  "still moves": "仍在运动",
  "no answer: {names}": "没有应答：{names}",
  "no reading": "没有读数",
  "its place is not known": "其位置未知",
  "{axis}: alarm {alarm}h; the next run tries to reset it": "{axis}：报警 {alarm}h；下一次运行会尝试复位",
  "alarm {alarm}h": "报警 {alarm}h",
  "not known while the drives do not answer": "驱动器没有应答，状态未知",
  "input {bit} of unit {unit} says that it is open": "设备 {unit} 的输入 {bit} 显示门已打开",
  "the drives of this station are on no line with registers": "本站的驱动器不在带寄存器的线路上",
  "it cannot be read: {why}": "无法读取：{why}",
  "{shown} °C, {low} to {high} °C are allowed": "{shown} °C，允许 {low} 至 {high} °C",
  "the checks of reference robot {robot} are not known yet": "参考机器人 {robot} 的检查尚未知",
  "reference robot {robot}: {why_text}": "参考机器人 {robot}：{why_text}",
  "reference robot {robot} has not passed a check since it was calibrated":
    "参考机器人 {robot} 自标定以来没有通过检查",
  "the last check of reference robot {robot} was valid until {until} UTC":
    "参考机器人 {robot} 的上次检查有效期至 {until} UTC",
  // the return into the workspace
  "The arm still stands {mm} mm outside its workspace.": "机械臂仍在工作空间外 {mm} mm。",
  "Step {number} of the way back led away from the workspace, from {before} mm to {after} mm outside; switch the drives off and look at the arm.":
    "返回的第 {number} 步远离了工作空间，从 {before} mm 到 {after} mm；请关断驱动器并查看机械臂。",
  "No way back into the workspace is known from where the arm stands; switch the drives off and move it by hand.":
    "从机械臂当前位置没有已知的返回路径；请关断驱动器并手动移动。",
  "It is not known where the arm stands.": "机械臂的位置未知。",
  "The linkage cannot close at these joint angles.": "在这些关节角下机构无法闭合。",
  "The arm stands within its workspace.": "机械臂位于其工作空间内。",
  "The arm stands {mm} mm outside its workspace.": "机械臂在其工作空间外 {mm} mm。",
  // prompts and steps of runs
  Measuring: "测量",
  "Measuring, pass {number}": "测量，第 {number} 轮",
  "Measuring, reading {number}": "测量，读数 {number}",
  "Verifying at fresh positions": "在新位置验证",
  Checking: "检查",
  "Checking the machine": "检查机器",
  "Looking for the cause": "查找原因",
  "Confirming at fresh positions": "在新位置确认",
  "Distinguishing the causes": "区分原因",
  "Measuring at the second mounting point": "在第二安装点测量",
  "Measuring at the first mounting point": "在第一安装点测量",
  "Reading the level": "读取水平仪",
  "Moving the mechanism": "移动测量机构",
  "Moving the mechanism back": "移回测量机构",
  "Mounting {number} of {all}": "第 {number} 次安装，共 {all} 次",
  "Operator {operator}, mounting {mounting}, calibration {number} of {all}":
    "操作员 {operator}，第 {mounting} 次安装，标定 {number}，共 {all} 次",
  "Put the level on the arm of joint {joint} and read its angle from the horizontal, positive when the elbow is higher. The drive says {angle} deg.":
    "请将水平仪放在关节 {joint} 的臂上，读取其与水平面的夹角，肘部较高时为正。驱动器显示 {angle}°。",
  "Mount the mechanism at its second mounting point, ({x}, {y}) mm, then confirm.":
    "请将测量机构安装在第二安装点 ({x}, {y}) mm，然后确认。",
  "Mount the mechanism back at its first mounting point, ({x}, {y}) mm, then confirm.":
    "请将测量机构装回第一安装点 ({x}, {y}) mm，然后确认。",
  "Operator {operator} of {operators}: take the mechanism off, mount it again at its mounting point as always, then confirm. Mounting {number} of {all}.":
    "操作员 {operator}（共 {operators} 名）：请拆下测量机构，像往常一样装回安装点，然后确认。第 {number} 次安装，共 {all} 次。",
  "A number is asked for, in {unit}.": "需要一个数字，单位 {unit}。",
  "{value} {unit} cannot be; between {low} and {high} is expected.":
    "{value} {unit} 不可能；应在 {low} 与 {high} 之间。",
  "Run {run} does not ask anything.": "运行 {run} 没有提问。",
  "Run {run} does not ask this (any more).": "运行 {run} 没有（或不再）提出该问题。",
  // requirements of a run
  "Run {run} has no zero offsets; calibrate again.": "运行 {run} 没有零点偏差；请重新标定。",
  "Nothing was written: the machine is not as run {run} measured it. {why_text} Calibrate again.":
    "未写入任何内容：机器与运行 {run} 测得的不同。{why_text}请重新标定。",
  "{why_text} The old zero offsets are in the drives.": "{why_text}驱动器中为旧零点。",
  "Nothing was written: the drives are not as they were left. {why_text} Calibrate again.":
    "未写入任何内容：驱动器与离开时不同。{why_text}请重新标定。",
  "{cause_text} The way back failed too: {why_text}": "{cause_text}恢复也失败了：{why_text}",
  "Robot {serial} has no passed calibration to be checked against; calibrate first.":
    "机器人 {serial} 没有可供检查对比的合格标定；请先标定。",
  "Robot {serial} has no passed calibration.": "机器人 {serial} 没有合格的标定。",
  "Run {run} has no error map: it identified no zero offsets.": "运行 {run} 没有误差图：未辨识零点偏差。",
  "Run {run} has no error map: its position error has no finite bound.":
    "运行 {run} 没有误差图：位置误差没有有限上限。",
  "Run {run} has no error map: no joint may be sent into the workspace.":
    "运行 {run} 没有误差图：不允许将关节移入工作空间。",
  "Run {run} has no error map: {why_text}": "运行 {run} 没有误差图：{why_text}",
  "Run {run} is no finished gauge study.": "运行 {run} 不是已完成的测量系统分析。",
  "Runs {first} and {run} differ in operators, mountings or repeats; evaluate them apart.":
    "运行 {first} 和 {run} 的操作员数、安装次数或重复次数不同；请分别评定。",
  "Robot {serial} is in two of these runs; give one study of each robot.":
    "机器人 {serial} 出现在其中两次运行中；请为每台机器人给出一次研究。",
  "Run {run} is no gauge study; only a gauge study can go on.":
    "运行 {run} 不是测量系统分析；只有测量系统分析可以继续。",
  "Run {run} is finished; start a new gauge study.": "运行 {run} 已完成；请开始新的测量系统分析。",
  "The file of robot {serial} has changed since; start a new gauge study.":
    "机器人 {serial} 的文件此后已更改；请开始新的测量系统分析。",
  "Run {run} has changed the drives' zeros since; start a new gauge study.":
    "运行 {run} 此后更改了驱动器零点；请开始新的测量系统分析。",
  "{holds_text} Run {run} was made before it: calibrate again.":
    "{holds_text}运行 {run} 早于该检查：请重新标定。",
  "Nothing is locked for robot {serial}.": "机器人 {serial} 没有任何锁定。",
  "Not checked yet.": "尚未检查。",
  "Check {run} passed.": "检查 {run} 通过。",
  "Locked: check {run} failed. {why_text} An engineer can clear it.":
    "已锁定：检查 {run} 未通过。{why_text}工程师可以解除。",
  "Not known: {why_text}": "未知：{why_text}",
  "Run {run} {what}.": "运行 {run} {what}。",
  "has no diagnosis whose explanations could be distinguished": "没有可供区分解释的诊断",
  "The file of robot {serial} has changed since; find the cause again.":
    "机器人 {serial} 的文件此后已更改；请重新查找原因。",
  "Run {run} has changed the drives' zeros since; find the cause again.":
    "运行 {run} 此后更改了驱动器零点；请重新查找原因。",
  "Run {run} is not what the drives hold: {why_text} Taught positions are as they were.":
    "驱动器中不是运行 {run} 的零点：{why_text}示教位置保持不变。",
  "Run {run} is of robot {serial}, not {other}.": "运行 {run} 属于机器人 {serial}，而不是 {other}。",
  "Run {run} was never applied; nothing was taught under it.": "运行 {run} 从未写入；没有在其下示教。",
  "The file of robot {serial} has changed since this run; calibrate again.":
    "机器人 {serial} 的文件在该运行之后已更改；请重新标定。",
  "Run {run} has been applied by run {other}; calibrate to apply again.":
    "运行 {run} 已由运行 {other} 写入；如需再次写入请重新标定。",
  "{state_text} There is nothing to roll back.": "{state_text}没有可恢复的内容。",
  "Run {run} is no calibration; it belongs to run {other}.": "运行 {run} 不是标定；它属于运行 {other}。",
  "Run {run} is of kind {kind}, not a calibration; calibrate to have offsets to write.":
    "运行 {run} 的类型为 {kind}，不是标定；请标定以获得可写入的零点。",
  "Run {run} has not passed; only the offsets of a pass are written.":
    "运行 {run} 未通过；只写入合格运行的零点。",
  "The zeros of the drives have been changed since, by run {run}.": "此后驱动器零点已由运行 {run} 更改。",
  "The readings do not determine the machine: {why_text}.": "读数不足以确定机器：{why_text}。",
  // taught positions
  "{source}: column {column} is missing; {columns} are needed.":
    "{source}：缺少列 {column}；需要 {columns}。",
  "{source}: column {column} is given twice; leave one of them out.":
    "{source}：列 {column} 给出了两次；请去掉一个。",
  "{place}: column {column} needs a number (given: {value}).":
    "{place}：列 {column} 需要一个数字（给出：{value}）。",
  "{source}: no positions.": "{source}：没有位置。",
  "{source}: line {line}: {name} has no angle of axis {axis}; both are needed.":
    "{source}：第 {line} 行：{name} 没有轴 {axis} 的角度；两者都需要。",
  // the station
  "Run {run} holds the rig; wait for its end or abort it.":
    "运行 {run} 正在占用工作站；请等待其结束或中止它。",
  "The station is shutting down; start it again first.": "工作站正在关闭；请先重新启动。",
  "{kind} is not carried out on the rig.": "{kind}不在机器上执行。",
  "Robot {serial} does not fit this station's drives: joint {joint} has {what}; correct its [joints] or the station's [[servo.joint]].":
    "机器人 {serial} 与本站驱动器不匹配：关节 {joint} 为 {what}；请更正其 [joints] 或本站的 [[servo.joint]]。",
  "There is no challenge {kind}; there is {kinds}.": "没有练习 {kind}；可用的有 {kinds}。",
  "Give the joint, 1 or 2.": "请给出关节，1 或 2。",
  "The size must be {bounds}.": "大小必须为 {bounds}。",
  "Run {run} is under way; wait for its end or abort it.": "运行 {run} 正在进行；请等待其结束或中止它。",
  "There is no exercise yet; choose a challenge first.": "还没有练习；请先选择任务。",
  "An unseen exercise is under way; reveal it at the training desk first.":
    "隐藏的练习正在进行；请先在训练台揭示。",
  "The backup folder {folder} cannot be used: {why}.": "无法使用备份文件夹 {folder}：{why}。",
  "The backup {target} cannot be written: {why}.": "无法写入备份 {target}：{why}。",
  "{target} exists already; a backup never overwrites.": "{target} 已存在；备份从不覆盖。",
  "The history cannot be used at this moment ({why}). Nothing was changed; try again.":
    "历史记录此刻无法使用（{why}）。未做任何更改；请重试。",
  "The service failed at this request; its log has the cause.": "服务处理该请求时出错；原因见其日志。",
  "The abort was sent but not confirmed; use the stop or the emergency stop.":
    "中止已发送但未确认；请使用停止或急停。",
  "{name} has the role mes and may end only runs that it started; run {run} is not one. The stop is open to everyone.":
    "{name} 的角色为 MES，只能结束自己启动的运行；运行 {run} 不是。任何人都可以停止。",
  "The examination did not end within {limit} s; a device holds its line.":
    "检查未在 {limit} s 内结束；有设备占用线路。",
  "This station has real devices; faults can be ordered of the emulated ones only.":
    "本站为真实设备；只有仿真设备可以设定故障。",
  "This station has real devices; the training desk is for emulated ones only.":
    "本站为真实设备；训练台仅用于仿真设备。",
  // the history
  "This idempotency key already belongs to run {run} with another request.":
    "该键已属于运行 {run} 的另一请求。",
  "There is no delivery {id}.": "没有投递 {id}。",
  "There is no user {name}.": "没有用户 {name}。",
  "There is no key {which}; `station key list` shows them.": "没有密钥 {which}；`station key list` 可列出。",
  "There is no key {which}.": "没有密钥 {which}。",
  "There is a user {name} already; choose another name.": "已有用户 {name}；请另选名称。",
  "{name} signs in with the plant's provider; a password or badge of the station would still open it after the provider has let the person go.":
    "{name}通过工厂的身份提供方登录；若另有本站的密码或工卡，提供方停用此人后仍能进入本站。",
  "Give another badge or PIN, or remove the badge; not both.":
    "请填写新的工卡或 PIN，或者移除工卡；不能同时进行。",
  "{name} has no PIN yet; give one with the badge.": "{name}还没有 PIN；请与工卡一起填写。",
  "{name} has no badge yet; give one with the PIN.": "{name}还没有工卡；请与 PIN 一起填写。",
  "Another user has this badge; remove it there first.": "该工卡属于另一位用户；请先在那里移除。",
  "Without the badge {name} has nothing to sign in with; give a password with it, or disable the user.":
    "没有工卡，{name}就无法登录；请同时设置密码，或停用该用户。",
  "There is a key {name} already; revoke it first or choose another name.":
    "已有密钥 {name}；请先吊销或另选名称。",
  "The {source} is a machine of model {model}. Its logs can be imported and diagnosed; measuring, applying and solving are for five-bars.":
    "{source} 是 {model} 型机器。其日志可以导入和诊断；测量、写入和求解仅用于五杆机构。",
  "Robot {serial} is not known here.": "此处没有机器人 {serial}。",
  "There is no calibration {run}.": "没有标定 {run}。",
  "Run {run} left no memory.": "运行 {run} 没有留下存储参数。",
  "Robot {serial} is said to be of type {type}, but robot {other} of that type has other nominal lengths; correct e, L and l or give it another type.":
    "机器人 {serial} 标为 {type} 型，但同型机器人 {other} 的标称长度不同；请更正 e、L 和 l，或改用其他型号。",
  "Robot {serial} is kept as a machine of model {own}; give another kind of machine another serial number.":
    "机器人 {serial} 已登记为 {own} 型机器；不同类型的机器请使用不同序列号。",
  "The cursor {cursor} is not one that a page gave.": "标记 {cursor} 不是页面给出的。",
  "Run {run} has no diagnosis.": "运行 {run} 没有诊断。",
  "No wire log of run {run} is kept here.": "此处没有运行 {run} 的线路记录。",
  "{name} is no query parameter of this address; {there}.": "{name} 不是该地址的参数；{there}。",
  "Run {run} was made from the log of an arm; readings.csv is that log as it was.":
    "运行 {run} 来自机械臂日志；readings.csv 即原始日志。",
  // certificates
  "Run {run} has not ended; its certificate can be made after that.":
    "运行 {run} 尚未结束；结束后才能出具证书。",
  "Run {run} has no verdict on a robot, so there is nothing to certify.":
    "运行 {run} 没有对机器人的结论，无可证明。",
  "Run {run} was made from the log of an arm, measured elsewhere; this station cannot certify it.":
    "运行 {run} 来自在别处测量的机械臂日志；本站不能出具证书。",
  "The record of run {run} is not as it ended: nothing is certified. `station verify` says more.":
    "运行 {run} 的记录与结束时不同：不出具证书。详情见 `station verify`。",
  // people
  "Sign in, or send an API key in the header `Authorization: Bearer KEY`.": "请登录。",
  "The session has ended; sign in again.": "会话已结束；请重新登录。",
  "This API key is not known here.": "此处没有该 API 密钥。",
  "This API key ({name}) was revoked at {at} UTC.": "该 API 密钥（{name}）已于 {at} UTC 吊销。",
  "This API key ({name}) expired at {at} UTC.": "该 API 密钥（{name}）已于 {at} UTC 过期。",
  "This needs the role {roles}; {name} has the role {role}.": "需要角色 {roles}；{name} 的角色为 {role}。",
  "Name or password is wrong.": "名称或密码错误。",
  "Badge or PIN is wrong.": "工卡或 PIN 错误。",
  "Too many failed sign-ins; wait {seconds} s.": "登录失败次数过多；请等待 {seconds} s。",
  "There is an administrator already, who can add users.": "已有管理员，可由其添加用户。",
  "This link was used already or is not this station's; start it again.":
    "该链接已用过或不属于本站；请重新启动工作站。",
  "A badge needs a PIN, and a PIN a badge; give both or none.":
    "工卡需要 PIN，PIN 也需要工卡；请同时给出或都不给出。",
  "Give a password, or a badge and its PIN, to sign in with.": "请给出用于登录的密码，或工卡及其 PIN。",
  "Give name and password, or badge and PIN.": "请给出名称和密码，或工卡和 PIN。",
  "{name} is the last administrator who can sign in; make another one first.":
    "{name} 是最后一个可以登录的管理员；请先创建另一个。",
  "A password has {fewest} to {most} characters.": "密码为 {fewest} 至 {most} 个字符。",
  "A PIN has {fewest} digits or more.": "PIN 至少 {fewest} 位数字。",
  "The station file has no [openid]; sign in with name and password.":
    "工作站文件没有 [openid]；请用名称和密码登录。",
  "{what} has {count} characters; use 1 to {most}.": "{what} 有 {count} 个字符；请使用 1 至 {most} 个。",
  "{what} holds full-width or otherwise special letters; use plain ones.":
    "{what} 含有全角或特殊字母；请使用普通字母。",
  "{what} mixes letters of {scripts}; use those of one script.":
    "{what} 混用了 {scripts} 的字母；请只用一种文字。",
  "{what} has a part of nothing or of dots alone between slashes; name each part.":
    "{what} 的斜杠之间有空白或只有点；请为每部分命名。",
  "{what} holds {character}; use letters, digits 0 to 9 and {between}.":
    "{what} 含有 {character}；请使用字母、数字 0 至 9 和 {between}。",
  "Name {name} holds the control character {character}; leave it out.":
    "名称 {name} 含有控制字符 {character}；请去掉。",
  "Serial {serial}": "序列号 {serial}",
  // references and readings
  "Reference {what} has a standard uncertainty of {sd} {unit}; {least} to {most} {unit} is believed. Check the value and its unit.":
    "参考 {what} 的标准不确定度为 {sd} {unit}；只接受 {least} 至 {most} {unit}。请检查数值及其单位。",
  "Reference {what} is {size} {unit} from what the robot file expects; at most {most} {unit} is believed. Check the value, its sign and the robot file.":
    "参考 {what} 与机器人文件的预期相差 {size} {unit}；最多接受 {most} {unit}。请检查数值、符号和机器人文件。",
  "Readings {names} disagree with the rest, more than a tenth of {readings}; measure again and check the scale and its mounting.":
    "读数 {names} 与其余不符，超过 {readings} 个的十分之一；请重新测量并检查光栅尺及其安装。",
  "Reading {reading}, columns theta1_deg and theta2_deg: {why_text} Check unit, sign and order of the joints and the robot file.":
    "读数 {reading}，列 theta1_deg 和 theta2_deg：{why_text}请检查单位、符号、关节顺序和机器人文件。",
  "Reading {reading}, columns theta1_deg and theta2_deg: the angles look like radians; give degrees.":
    "读数 {reading}，列 theta1_deg 和 theta2_deg：角度似乎为弧度；请用度。",
  "Reading {reading}, column theta{joint}_deg: {angle} deg is beyond what the workspace needs, joint {number} from {low} to {high} deg. Check unit, sign and order of the joints and the robot file.":
    "读数 {reading}，列 theta{joint}_deg：{angle}° 超出工作空间所需，关节 {number} 为 {low} 至 {high}°。请检查单位、符号、关节顺序和机器人文件。",
  "Only {count} different places were measured; at least {fewest} are needed (paper, section 5).":
    "只测量了 {count} 个不同位置；至少需要 {fewest} 个（论文第 5 节）。",
  "Reading {reading}, column scale_mm: the distance is {off} mm off what its joint angles say, compared with the other readings; check that the row is in its place.":
    "读数 {reading}，列 scale_mm：与其他读数相比，距离与关节角相差 {off} mm；请检查该行位置是否正确。",
  "Impossible result: {what}; check the robot file and the readings' columns, then run the diagnosis.":
    "结果不可能：{what}；请检查机器人文件和读数的列，然后运行诊断。",
  "Only {count} numbers were measured for {unknown} unknowns without a tolerance; measure more poses.":
    "对 {unknown} 个无公差的未知量只测得 {count} 个数；请测量更多位姿。",
  "The identification cannot start: {why_text}; check the robot file and that angles and readings belong together.":
    "辨识无法开始：{why_text}；请检查机器人文件以及角度与读数是否对应。",
  "The identification did not converge ({why}); check that angles and distances belong together.":
    "辨识未收敛（{why}）；请检查角度与距离是否对应。",
  "The workspace needs {needed} mm of the scale's {travel} mm travel; check [workspace] and [mechanism] in the robot file.":
    "工作空间需要 {needed} mm，光栅尺行程为 {travel} mm；请检查机器人文件中的 [workspace] 和 [mechanism]。",
  "Not enough data to judge: {what} are needed.": "数据不足以判断：需要 {what}。",
  "Only {count} fresh readings; at least {fewest} are needed to confirm.":
    "只有 {count} 次新读数；确认至少需要 {fewest} 次。",
  "The fresh readings are of {what} {which}, which the measurement sequence never used.":
    "新读数来自 {what} {which}，测量序列从未使用过。",
  // bodies of requests
  "Input holds characters that cannot be here, or lacks some that must":
    "输入含有不允许的字符，或缺少必需的字符",
  "{field}: {why_text}": "{field}：{why_text}",
  "Input should be greater than {limit}": "输入应大于 {limit}",
  "Input should be greater than or equal to {limit}": "输入应不小于 {limit}",
  "Input should be less than {limit}": "输入应小于 {limit}",
  "Input should be less than or equal to {limit}": "输入应不大于 {limit}",
  "String should have at least {count} character": "至少需要 {count} 个字符",
  "String should have at least {count} characters": "至少需要 {count} 个字符",
  "String should have at most {count} characters": "最多允许 {count} 个字符",
  "Field required": "缺少该项",
  "Input should be a valid number": "输入应为数字",
  robot_serial: "机器人序列号",
  operator: "操作员",
  // the examination of the devices
  "{name}, emulated": "{name}（仿真）",
  "{name} at {address}": "{name}，{address}",
  "connects within {ms} ms": "{ms} ms 内连接",
  "held by {names} too": "还被 {names} 占用",
  "end that program; two that read one port take each other's bytes":
    "请结束该程序；两个程序读同一端口会互相抢走字节",
  "names its adapter; it is {port} at present": "已指明适配器；目前为 {port}",
  "its adapter is {name}": "其适配器为 {name}",
  "name it {name} in the station file: {port} may be another one after plugging":
    "请在工作站文件中写 {name}：重新插拔后 {port} 可能是另一个",
  "has no name under {folder}": "在 {folder} 下没有名称",
  "its adapter has no serial number; a udev rule can name it by its socket":
    "其适配器没有序列号；可用 udev 规则按插口命名",
  "check that the gateway is switched on, its network address and its port":
    "请检查网关是否通电、其网络地址和端口",
  "adapters there are: {names}": "现有适配器：{names}",
  "this device was there and failed: look at its line for noise": "该设备曾在线后失效：请检查其线路干扰",
  "shows alarm {alarm}h": "报警 {alarm}h",
  "find its cause in the maker's manual; the next run resets it":
    "请在制造商手册中查找原因；下一次运行会复位",
  "moves, although this program moves nothing": "正在运动，但本程序没有驱动任何轴",
  "find out who moves it": "请查明是谁在驱动",
  "is powered": "已通电",
  "stands {mm} mm outside its workspace": "在其工作空间外 {mm} mm",
  "cannot stand where the drives say: the linkage does not close": "不可能在驱动器所示位置：机构不闭合",
  "{where}; with the drives exchanged it would be within": "{where}；若交换驱动器则在其内",
  "compare with the arm; if it stands elsewhere, exchange the units of the two [[servo.joint]]":
    "请与机械臂对照；若位置不同，请交换两个 [[servo.joint]] 的地址",
  "compare with the arm; `station retract` brings it back": "请与机械臂对照；“移回工作空间”可将其移回",
  "exchange the two addresses in the station file, or the plugs": "请交换工作站文件中的两个地址，或交换插头",
  "if that is not so, check [interlocks.{id}] in the station file":
    "若并非如此，请检查工作站文件中的 [interlocks.{id}]",
  "{text} ({limits})": "{text}（{limits}）",
  "{text} ({limits}): {shows}": "{text}（{limits}）：{shows}",
  "at most {value} mm": "至多 {value} mm",
  "at most {value} °": "至多 {value}°",
  "{low} to {high} °C": "{low} 至 {high} °C",
  "All devices answer": "所有设备均有应答",
  "Both drives are ready": "两个驱动器均已就绪",
  "The arm stands within its workspace": "臂位于其工作空间内",
  "The scale reads": "光栅尺有读数",
  "The scale moves as far as the joints say": "光栅尺的移动量与关节一致",
  "Each joint keeps to its way": "每个关节都保持在其路径上",
  "The guard door is closed": "防护门已关闭",
  "The temperature is within its window": "温度在允许范围内",
  "The reference check is valid": "参考检查有效",
  // wire traffic
  "drive {unit}: {address}h {name} = {value}": "{value}（寄存器 {address}h）",
  "drive {unit}: {address}h = {value}": "{value}（寄存器 {address}h）",
  "drive {unit}: {address}h {name} on = {bytes}": "{name}及其后 = {bytes}（寄存器 {address}h）",
  "drive {unit}: {address}h on = {bytes}": "寄存器 {address}h 及其后 = {bytes}",
  "drive {unit}: done": "已执行",
  "drive {unit}: refuses with exception {code}": "拒绝，异常 {code}",
  "drive {unit}: read {what}": "驱动器 {unit}：读取{what}",
  "drive {unit}: write {what}": "驱动器 {unit}：写入{what}",
  "drive {unit}: function {code}h, {bytes}": "驱动器 {unit}：功能 {code}h，{bytes}",
  "bytes {bytes}": "字节 {bytes}",
  "{name} and {count} more": "{name}等另 {count} 个",
  "what is the value?": "当前值？",
  "the value is {value}": "值为 {value}",
  "the value is {value}, marked as faulty": "值为 {value}，标为错误",
  "resume sending (XON)": "继续发送（XON）",
  "head {head}: {command} = {value}": "读数头 {head}：{command} = {value}",
  "head {head}: {command}": "读数头 {head}：{command}",
  "pulses a turn": "每转脉冲数",
  "switch on": "接通",
  "motion status": "运动状态",
  alarm: "报警",
  "alarm reset": "报警复位",
  trigger: "触发",
  "position, pulses": "位置，脉冲",
  "path 0: mode, target, speed, ramps, pause, trigger": "路径 0：模式、目标、速度、斜坡、停顿、触发",
  "target of path 0, pulses": "路径 0 的目标，脉冲",
  "control mode": "控制模式",
  "function of input {number}": "输入 {number} 的功能",
  "function of output {number}": "输出 {number} 的功能",
  outputs: "输出",
  inputs: "输入",
  "direct data: number, type, position, speed, ramps, torque, trigger":
    "直接数据：编号、类型、位置、速度、斜坡、转矩、触发",
  "position of the direct data, steps": "直接数据的位置，步",
  "position, steps": "位置，步",
  "position preset": "位置预置",
  resolution: "分辨率",
  "communication watchdog, ms": "通信看门狗，ms",
  "On the way to position {position} the scale moved {doubt} mm beside what the joints say; check its rod and channel.":
    "前往位置 {position} 途中光栅尺的移动与关节相差 {doubt} mm；请检查其连杆和通道。",
  "While position {position} was read, joint {joint} came to stand at {angle} deg instead of {wanted}; has its drive restarted?":
    "在位置 {position} 读数时，关节 {joint} 停在 {angle}° 而不是 {wanted}；其驱动器是否重新启动过？",
  position: "位置",
  "type and firmware": "型号和固件",
  "received a wrong check byte": "收到错误的校验字节",
  "refuses, or cannot measure": "拒绝，或无法测量",
  "refuses the value": "拒绝该值",
  "identifies itself as {identity}": "标识为 {identity}",
  "{axis} counts {numerator}/{denominator} steps a turn, the station file says {counts}; correct one of them.":
    "{axis}每转 {numerator}/{denominator} 步，工作站文件中为 {counts}；请更正其中之一。",
  "{format}, in place of {wanted}": "{format}，代替 {wanted}",
  "remove override= unless the port is emulated": "若端口不是仿真的，请去掉 override=",
  "its adapter sends back what it is sent, as echo=1 says": "其适配器按 echo=1 所述将收到的内容发回",
  "{axis} has lost its power during this run and may count from elsewhere: no zero is written; calibrate again.":
    "{axis}在本次运行中断过电，计数起点可能已变：不写入零点；请重新标定。",
  // receivers of events
  "nothing accepts connections there": "该处不接受连接",
  "the connection was closed before the answer was complete": "连接在应答完成前被关闭",
  "there is no way to that computer in the network": "网络无法到达该计算机",
  "the disk is full": "磁盘已满",
  "the station may not write there": "标定站无权写入该处",
  "the folder is a file": "该文件夹是一个文件",
  "its certificate is not accepted: {reason}": "其证书不被接受：{reason}",
  "no encrypted connection could be made": "无法建立加密连接",
  "no computer of that name is known": "没有该名称的计算机",
  "no answer within the time limit": "在时限内没有应答",
  "answered {status}": "应答为{status}",
  "no connection to the broker": "未连接到代理",
  "the broker did not acknowledge": "代理未确认",
  "the broker answers: {reason}": "代理应答：{reason}",
  "the broker refuses the connection: {reason}": "代理拒绝连接：{reason}",
  acknowledged: "已确认",
};
