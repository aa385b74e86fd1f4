/** Sentences that the station says in English only: numbers are {}, in their order. */
export const sentences: Record<string, string> = {
  // what the drives hold
  "The drives hold the old zero offsets.": "驱动器中为旧零点。",
  "The drives hold these zero offsets.": "驱动器中为这些零点。",
  "One drive holds its new zero offset, the other does not.": "一个驱动器已有新零点，另一个没有。",
  "It is unknown whether a drive accepted its new zero. The next run will check.":
    "不清楚驱动器是否接受了新零点。下一次运行会检查。",
  "The zeros of the drives have been changed since, for another run.":
    "此后驱动器的零点已因另一次运行而更改。",
  "Rolled back: the drives hold the old zero offsets again.": "已恢复：驱动器中又是旧零点。",
  // why an adaptive plan ended
  "the plan has ended": "方案已结束",
  "the most readings are taken": "已达到最大读数次数",
  "the wanted accuracy is reached": "已达到要求的精度",
  "readings cannot reach the wanted accuracy": "增加读数无法达到要求的精度",
  "further readings would not help": "更多读数没有帮助",
  // what earlier calibrations found
  "geometry and mechanism as earlier calibrations found them": "以前标定得到的几何与测量机构参数",
  "not used: it contradicts the new readings; has the mechanism been remounted?":
    "未使用：与新读数矛盾；测量机构是否重新安装过？",
  // the weakest direction
  "both arms together": "两臂同向",
  "one arm against the other": "两臂反向",
  "both arms together with a sideways error of the mechanism": "两臂同向，并伴随测量机构的横向安装误差",
  "one arm against the other with a sideways error of the mechanism":
    "两臂反向，并伴随测量机构的横向安装误差",
  "both arms together with an error of the mechanism along its height":
    "两臂同向，并伴随测量机构的高度安装误差",
  "one arm against the other with an error of the mechanism along its height":
    "两臂反向，并伴随测量机构的高度安装误差",
  "measure the mechanism's mounting error to {} mm (sd {} deg)":
    "测量该机构的安装误差，精确到 {} mm（此后标准不确定度为 {}°）",
  "repeat the sequence with the mechanism mounted {} mm aside (sd {} deg)":
    "将测量机构横移 {} mm 安装后重复测量序列（此后标准不确定度为 {}°）",
  // remedies
  "Adjust or replace the reducer, or approach every position from the same side.":
    "调整或更换减速器，或始终从同一侧趋近每个位置。",
  "Align the guide rods; check that nothing forces the scale.": "校正导杆；检查光栅尺是否受力。",
  "Check the head's coupling and the friction of the slider.": "检查读数头的连接和滑块的摩擦。",
  "Check the mounting of head and scale and the readout's supply, then measure again.":
    "检查读数头和光栅尺的安装以及数显表的供电，然后重新测量。",
  "Check the reducer stage that turns n times a joint turn, or keep the term in the model.":
    "检查关节每转一圈转 n 圈的减速级，或将该项保留在模型中。",
  "Clean and realign the head; check what has this period (graduation, rolling element, screw).":
    "清洁并重新校正读数头；检查具有该周期的部件（刻线、滚动体、丝杠）。",
  "Correct the drive's ratio or pulses per turn.": "更正驱动器的传动比或每转脉冲数。",
  "Let readout and machine warm up; check the mounting of scale and base.":
    "让数显表和机器预热；检查光栅尺和机架的安装。",
  "Let the machine warm up before it is measured; check the mounting of scale and mechanism.":
    "测量前让机器预热；检查光栅尺和测量机构的安装。",
  "Measure the link; correct the robot file or replace the link.": "测量该杆件；更正机器人文件或更换杆件。",
  "No entry of the catalogue has this shape; look at the residual, and at what moves with it.":
    "目录中没有这种形状的误差；请查看残差以及与其一同变化的量。",
  "Re-centre or replace the encoder, or keep the term in the controller's model.":
    "重新对中或更换编码器，或将该项保留在控制器的模型中。",
  "Replace the bearing of the passive joint.": "更换被动关节的轴承。",
  "Set the readout's linear compensation, or replace the scale.": "设置数显表的线性补偿，或更换光栅尺。",
  "Stiffen the drive train or compensate for the torque in the controller.":
    "加强传动链的刚度，或在控制器中补偿转矩。",
  "The same is seen where `[joints] ratio` or `counts_per_rev` is wrong: check both.":
    "`[joints] ratio` 或 `counts_per_rev` 有误时现象相同：请检查两者。",
  "The same is seen where the readout has a wrong factor: check its setting.":
    "数显表的系数有误时现象相同：请检查其设置。",
  "The same is seen where the robot file has a wrong length: compare it with the drawing.":
    "机器人文件中的长度有误时现象相同：请与图纸核对。",
  "Tighten coupling or belt, check the encoder cable, then calibrate again.":
    "紧固联轴器或皮带，检查编码器电缆，然后重新标定。",
  "Warm up before calibrating, or compensate for the recorded temperature.":
    "标定前预热，或按记录的温度进行补偿。",
  // what distinguishes one effect from others
  "Compare the scale with a gauge block or an interferometer.": "用量块或干涉仪与光栅尺比对。",
  "Compare the scale with an interferometer over its travel.": "在全行程上用干涉仪与光栅尺比对。",
  "Measure again with something changed: the payload, the mounting point, the speed.":
    "改变某个条件后重新测量：负载、安装点或速度。",
  "Measure the link, or repeat the sequence from a second mount of the mechanism.":
    "测量该杆件，或在测量机构的第二个安装位置重复测量序列。",
  "Reach the same position once with the slider moving up and once moving down.":
    "使滑块一次向上、一次向下运动到同一位置。",
  "Read finely over two or three periods of the joint angle.": "在关节角的两三个周期内密集读数。",
  "Read finely over two or three periods of travel, or start at another point of the scale.":
    "在行程的两三个周期内密集读数，或从光栅尺的另一处开始。",
  "Read over a wider range of the joint, or from a second mount of the mechanism.":
    "在关节更大的范围内读数，或在测量机构的第二个安装位置读数。",
  "Read the first positions again: the step stays, at every position alike.":
    "重新读取最初的位置：跳变仍在，且各处相同。",
  "Read the first positions again: the step stays.": "重新读取最初的位置：跳变仍在。",
  "Read the same positions from the other side.": "从另一侧趋近相同的位置并读数。",
  "Repeat the measurement sequence warm, with the temperature recorded.":
    "在热态下重复测量序列，并记录温度。",
  "Repeat the measurement sequence with a payload on the platform.": "在平台上加负载后重复测量序列。",
  "Repeat the measurement sequence with the load on the platform reversed.":
    "将平台上的载荷反向后重复测量序列。",
  "Stand still at one position and read for as long as the measurement sequence took.":
    "停在一个位置，读数时间与测量序列等长。",
  "Turn the joint through its whole range against an inclinometer.": "对照倾角仪使关节转过全部范围。",
  // the examination of the devices
  "answers: {} replies, {} ms as a rule, {} ms the slowest": "有应答：{} 次，通常 {} ms，最慢 {} ms",
  "reads {} mm": "读数为 {} mm",
  "stands at {} deg": "位于 {}°",
  "is not powered; a run powers it": "未上电；运行时会上电",
  "the arm": "臂",
  "stands within its workspace": "位于其工作空间内",
  interlocks: "联锁",
};
